// Tests whether time grows linearly with the number of points. One shape is seen from one
// place at growing density. The exponent is chosen to show the same share of the points.
import { PointCloud } from "hidden-point-removal";

import { bumpy, BUMPY_SIZES, type Cloud } from "./clouds.js";
import type { Engine } from "./engines.js";
import type { Point, Task } from "./measure.js";
import { measureAll } from "./speed.js";
import { median, type Row, type Table } from "./report.js";
import { tasksFor } from "./views.js";

/** The wanted share of visible points, in %. The dragon has this share at exponent 3. */
const SHARE = 33;
const SHARE_TOLERANCE = 0.05;

export async function timeSizes(engines: Engine[]): Promise<Table> {
  const rows: Row[] = [];
  const smallest = new Map<string, number>();
  for (const name of Object.keys(BUMPY_SIZES) as (keyof typeof BUMPY_SIZES)[]) {
    const cloud = bumpy(name);
    const [usual] = tasksFor(cloud) as [Task];
    const exponent = exponentForShare(cloud, usual.viewpoint);
    const outcomes = await measureAll(cloud, [{ ...usual, exponent }], engines);
    const points = cloud.positions.length / 3;
    const row: Row = { cloud: name, source: cloud.source, points, exponent: exponent.toFixed(4) };
    for (const [engine, [outcome]] of outcomes) {
      const nanoseconds = (median(outcome!.cold) / points) * 1e6;
      smallest.set(engine, smallest.get(engine) ?? nanoseconds);
      row["share %"] = (outcome!.visible / points) * 100;
      row[`${engine} ms`] = median(outcome!.cold);
      row[`${engine} ns a point`] = nanoseconds;
      row[`${engine} ÷ smallest`] = nanoseconds / smallest.get(engine)!;
    }
    rows.push(row);
  }
  const note =
    `Cold queries, as above, of one shape from one viewpoint, at the exponent that shows ${SHARE} % of the points; ` +
    "the last column of each engine divides the time of a point by the time of a point in the smallest cloud.";
  return { title: "Time a point", note, rows };
}

/** Finds the exponent for `SHARE` by halving an interval. A larger radius shows more points. */
function exponentForShare(cloud: Cloud, viewpoint: Point): number {
  const points = new PointCloud(cloud.positions);
  let [low, high] = [1, 8];
  for (;;) {
    const exponent = (low + high) / 2;
    const share = (points.visibleFrom(viewpoint, { exponent }).count / points.length) * 100;
    if (Math.abs(share - SHARE) < SHARE_TOLERANCE || high - low < 1e-6) {
      points.dispose();
      return exponent;
    }
    if (share < SHARE) low = exponent;
    else high = exponent;
  }
}
