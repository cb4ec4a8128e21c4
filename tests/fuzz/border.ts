// The public API under arguments of any kind. Every call must be answered correctly, or refused as the contract says.
import fc from "fast-check";
import { init } from "hidden-point-removal";
import { init as initLite } from "hidden-point-removal/lite";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { actingArguments, actingChanges, disappearingMemory } from "./border/acting.js";
import { changes } from "./border/changes.js";
import { exports } from "./border/exports.js";
import { flights } from "./border/flight.js";
import { isOwn } from "./border/hostile.js";
import { structured } from "./border/structured.js";

interface Property {
  name: string;
  /** This many cases take about one second at most. */
  pace: number;
  /** Tries this many cases. `wrong` describes the fault and how to repeat it. */
  check: (seed: number, cases: number) => Promise<{ tried: number; wrong: string | undefined }>;
}

const entry = <T>(name: string, pace: number, property: fc.IAsyncProperty<T>): Property => ({
  name,
  pace,
  check: async (seed, cases) => {
    const found = await fc.check(property, { seed, numRuns: cases });
    const wrong = found.failed ? `${String(found.errorInstance)}\n${fc.defaultReportMessage(found)}` : undefined;
    return { tried: found.numRuns, wrong };
  },
});

export const PROPERTIES: readonly Property[] = [
  entry("any sequence of changes and questions", 20, changes),
  entry("arguments that act while they are read", 100, actingArguments),
  entry("changes that act while they are read", 40, actingChanges),
  entry("memory that goes away while arguments are read", 40, disappearingMemory),
  entry("workers that end in flight", 10, flights),
  entry("every export, with hostile values", 300, exports),
  entry("structured clouds, here, in a worker and in several", 10, structured),
];

/** Runs all properties in turn until the time is over. Returns how many runs found something wrong. */
export async function fuzzBorder(minutes: number, seed: number): Promise<number> {
  await Promise.all([init(), initLite()]);
  // The error of a listener is the caller's: it disturbs no answer.
  process.on("uncaughtException", (error) => {
    if (!isOwn(error)) throw error;
  });
  // Keeps the shared worker alive between cases.
  const resident = await WorkerPointCloud.create([], { shared: true });
  const end = Date.now() + 60_000 * minutes;
  const all = new Map<string, { tried: number; wrong: number }>();
  let round = 0;
  do {
    for (const { name, pace, check } of PROPERTIES) {
      const { tried, wrong } = await check(seed + round, 3 * pace);
      const sums = all.get(name) ?? { tried: 0, wrong: 0 };
      sums.tried += tried;
      if (wrong !== undefined) {
        sums.wrong += 1;
        console.log(`WRONG: ${name}: ${wrong}`);
      }
      all.set(name, sums);
    }
    round += 1;
  } while (Date.now() < end);
  await resident.dispose();
  console.log(`border: ${round} rounds, seeds ${seed} to ${seed + round - 1}`);
  for (const [name, { tried, wrong }] of all) {
    console.log(`  ${name}: ${tried} cases, ${wrong} wrong`);
  }
  return [...all.values()].reduce((sum, { wrong }) => sum + wrong, 0);
}
