// Compares two workers with one: eight views of a million points.
import { PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";

import { WrongAnswer } from "./check.js";
import { bumpy } from "./clouds.js";
import { digestOf } from "./measure.js";
import { median, type Row, type Table } from "./report.js";
import { orbit } from "./views.js";

const OPTIONS = { exponent: 3 };
const RUNS = 5;
const VIEWS = 8;

export async function timeWorkers(): Promise<Table> {
  const million = bumpy("bumpy-1m");
  const at = orbit(million);
  const viewpoints = Array.from({ length: VIEWS }, (_, i) => at((360 * i) / VIEWS));
  const alone = new PointCloud(million.positions);
  const expected = digestOf(alone.coverage(viewpoints, OPTIONS));
  alone.dispose();
  const times = new Map<number, number[]>([
    [1, []],
    [2, []],
  ]);
  // In turns, so that other work on the machine slows both alike.
  for (let run = 0; run < RUNS; run++) {
    for (const [workers, milliseconds] of times) {
      console.error(`${million.name}: ${workers} worker(s)…`);
      const cloud = await WorkerPointCloud.create(million.positions, { workers });
      const start = performance.now();
      const counts = await cloud.coverage(viewpoints, OPTIONS);
      milliseconds.push(performance.now() - start);
      await cloud.dispose();
      if (digestOf(counts) !== expected) throw new WrongAnswer(`${workers} worker(s) give another answer than none`);
    }
  }
  const one = median(times.get(1)!);
  const rows = [...times].map(([workers, all]): Row => {
    const cold = median(all);
    return { cloud: million.name, workers, "cold ms": cold, "× faster than one": one / cold };
  });
  const note = "Median milliseconds from asking to the answer, in Node, messages included. All answers are the same.";
  return { title: "Several workers", note, rows };
}
