// The short form of tests/fuzz/stream.ts: the same seeds every time.
import { expect, it } from "vitest";
import { type Counts, tryCases } from "../fuzz/stream";

it("octrees from servers that fail, and with changed bytes, are answered as one version of them, or refused", async () => {
  const tallies = new Map<string, Counts>();
  const said: string[] = [];
  await tryCases(1, 400, tallies, (text) => said.push(text));
  expect(said.slice(0, 5).join("\n\n")).toBe("");
  const all = [...tallies.values()];
  expect(tallies.size).toBe(8);
  for (const { exact, refused } of all) expect(Math.min(exact, refused)).toBeGreaterThan(0);
  expect(all.reduce((sum, { tried }) => sum + tried, 0)).toBe(400);
});
