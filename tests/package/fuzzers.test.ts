// The short forms of the fuzzers: the same seeds every time. `npm run fuzz` runs them for any time.
import { init } from "hidden-point-removal";
import { init as initLite } from "hidden-point-removal/lite";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { PROPERTIES } from "../fuzz/border.js";
import { tryRound } from "../fuzz/files";
import { type Counts, tryCases } from "../fuzz/stream";

const SEED = 20261122;
let resident: WorkerPointCloud;

beforeAll(async () => {
  await Promise.all([init(), initLite()]);
  // Keeps the shared worker alive between cases.
  resident = await WorkerPointCloud.create([], { shared: true });
});

afterAll(async () => {
  await resident.dispose();
});

describe(`every call is answered correctly or refused as documented, with seed ${SEED}`, () => {
  it.each(PROPERTIES)("$name", async ({ check, pace }) => {
    expect((await check(SEED, Math.ceil(pace / 2))).wrong).toBeUndefined();
  });
});

it("random changes of valid files are refused, or read as a naive reader reads them", async () => {
  const tallies: Parameters<typeof tryRound>[1] = new Map();
  const said: string[] = [];
  for (let seed = 1; seed <= 60; seed++) await tryRound(seed, tallies, (text) => said.push(text));
  expect(said.slice(0, 5).join("\n\n")).toBe("");
  const all = [...tallies.values()];
  expect(tallies.size).toBe(15);
  for (const { valid, read, refused } of all) expect(Math.min(valid, read, refused)).toBeGreaterThan(0);
  expect(all.reduce((sum, { read, refused }) => sum + read + refused, 0)).toBe(1200);
});

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
