// The short form of tests/fuzz/files.ts: the same seeds every time.
import { expect, it } from "vitest";
import { tryRound } from "../fuzz/files";

it("random changes of valid files are refused, or read as a naive reader reads them", async () => {
  const tallies: Parameters<typeof tryRound>[1] = new Map();
  const said: string[] = [];
  for (let seed = 1; seed <= 60; seed++) await tryRound(seed, tallies, (text) => said.push(text));
  expect(said.slice(0, 5).join("\n\n")).toBe("");
  const all = [...tallies.values()];
  expect(tallies.size).toBe(12);
  for (const { valid, read, refused } of all) expect(Math.min(valid, read, refused)).toBeGreaterThan(0);
  expect(all.reduce((sum, { read, refused }) => sum + read + refused, 0)).toBe(1200);
});
