// The order in which the checks of `npm test` run.
import { expect, it } from "vitest";

import { chosenParts } from "../../scripts/checks/check.js";
import { type Job, inOrder, withNeeds } from "../../scripts/lib/schedule.js";

const JOBS: Job[] = [
  { title: "set-up" },
  { title: "build", needs: ["set-up"], locks: "cargo" },
  { title: "page", needs: ["build"] },
  { title: "core", needs: ["set-up"], locks: "cargo" },
  { title: "format" },
];

/** Runs the jobs, each for some turns of the event loop. Returns their begins and ends in order. */
async function events(jobs: Job[], workers: number): Promise<string[]> {
  const seen: string[] = [];
  await inOrder(jobs, workers, async ({ title }) => {
    seen.push(`+${title}`);
    for (let turn = 0; turn < 5; turn++) await Promise.resolve();
    seen.push(`-${title}`);
  });
  return seen;
}

it("runs one after another where there is one worker", async () => {
  const titles = (await events(JOBS, 1)).filter((event) => event.startsWith("-"));
  expect(titles).toEqual(["-set-up", "-build", "-page", "-core", "-format"]);
});

it("begins a job after what it needs, and never two with one lock", async () => {
  const seen = await events(JOBS, 3);
  const at = (event: string) => seen.indexOf(event);
  expect(seen).toHaveLength(2 * JOBS.length);
  expect(seen.slice(0, 2)).toEqual(["+set-up", "+format"]);
  expect(at("+build")).toBeGreaterThan(at("-set-up"));
  expect(at("+page")).toBeGreaterThan(at("-build"));
  expect(at("+core")).toBeGreaterThan(at("-build"));
});

it("takes what the chosen jobs need, at any remove, and nothing else", () => {
  const chosen = withNeeds(JOBS, ({ title }) => title === "page");
  expect(chosen.map(({ title }) => title)).toEqual(["set-up", "build", "page"]);
});

it("knows its parts and lists them where a name is unknown", () => {
  expect([...chosenParts(["core", "page"])]).toEqual(["core", "page"]);
  expect(chosenParts([]).size).toBeGreaterThan(5);
  expect(() => chosenParts(["core", "pages"])).toThrow(/no part "pages"[^]*core[^]*package[^]*python/);
  expect(() => chosenParts(["toString"])).toThrow(/no part/);
});
