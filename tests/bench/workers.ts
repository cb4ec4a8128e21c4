// Compares two workers with one, on a million points.
import { HprError, PointCloud } from "hidden-point-removal";
import { WorkerPointCloud, type WorkerPointCloudOptions } from "hidden-point-removal/worker";

import { WrongAnswer } from "./check.js";
import { bumpy, type Cloud } from "./clouds.js";
import { digestOf, type Point } from "./measure.js";
import { median, type Row, type Table } from "./report.js";
import { orbit } from "./views.js";

const EXPONENT = 3;
const RUNS = 5;
const WORKERS = [1, 2];
const STEP = 1;

/** Undefined, with a message, if the package has only one worker for each cloud. */
export async function timeWorkers(): Promise<Table | undefined> {
  if (!(await hasWorkers())) {
    console.error("Left out: several workers, which the package does not have.");
    return undefined;
  }
  const million = bumpy("bumpy-1m");
  const { positions, name, source } = million;
  const path = [0, 1, 2, 3].map((step) => orbit(million)(step * STEP));
  const expected = withoutWorker(positions, path);
  const rows: Row[] = [];
  for (const workers of WORKERS) {
    console.error(`${name}: ${workers} worker(s)…`);
    const cold: number[] = [];
    const moving: number[] = [];
    for (let run = 0; run < RUNS; run++) {
      const options: WorkerPointCloudOptions & { workers: number } = { workers };
      const cloud = await WorkerPointCloud.create(positions, options);
      const answers = await inTurn(path, (view) => query(cloud, view));
      cold.push(answers[0]!.milliseconds);
      moving.push(...answers.slice(1).map(({ milliseconds }) => milliseconds));
      const same = answers.every(({ digest }, view) => digest === expected[view]);
      if (!same) {
        throw new WrongAnswer(`${name}: ${workers} worker(s) give another answer than the package without workers`);
      }
      await cloud.dispose();
    }
    const [one] = rows;
    const [coldMs, movingMs] = [median(cold), median(moving)];
    rows.push({
      cloud: name,
      source,
      exponent: EXPONENT,
      workers,
      "cold ms": coldMs,
      "× faster than one, cold": one === undefined ? 1 : (one["cold ms"] as number) / coldMs,
      [`${STEP}° ms`]: movingMs,
      [`× faster than one, ${STEP}°`]: one === undefined ? 1 : (one[`${STEP}° ms`] as number) / movingMs,
    });
  }
  const note = "Median milliseconds from asking to the answer, in Node, messages included. All answers are the same.";
  return { title: "Several workers", note, rows };
}

function withoutWorker(positions: Cloud["positions"], path: Point[]): string[] {
  const cloud = new PointCloud(positions);
  const digests = path.map((view) => digestOf(cloud.visibleFrom(view, { exponent: EXPONENT }).indices));
  cloud.dispose();
  return digests;
}

async function hasWorkers(): Promise<boolean> {
  const options: WorkerPointCloudOptions & { workers: number } = { workers: 2 };
  try {
    const cloud = await WorkerPointCloud.create([0, 0, 1], options);
    await cloud.dispose();
    return true;
  } catch (error) {
    if (error instanceof HprError && error.code === "option") return false;
    throw error;
  }
}

async function query(cloud: WorkerPointCloud, view: Point): Promise<{ milliseconds: number; digest: string }> {
  const start = performance.now();
  const { indices } = await cloud.visibleFrom(view, { exponent: EXPONENT });
  return { milliseconds: performance.now() - start, digest: digestOf(indices) };
}

/** Asks one view after another, as a moving camera does. */
async function inTurn<T, R>(items: T[], ask: (item: T) => Promise<R>): Promise<R[]> {
  const results: R[] = [];
  for (const item of items) results.push(await ask(item));
  return results;
}
