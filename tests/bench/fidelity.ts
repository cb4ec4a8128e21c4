// How well the choice of R does: errors against ray-traced visibility, in % of
// all points, and relative to the best R of each view.
import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";

import { PointCloud, type VisibilityOptions } from "hidden-point-removal";

import { bunny36k, type Cloud, dragon, sharedFile } from "./clouds.js";
import { median, type Table } from "./report.js";

interface Truth {
  bbox_diagonal: number;
  views: { viewpoint: [number, number, number] }[];
}

/** Exponents scanned for the best one. */
const SCAN = Array.from({ length: 13 }, (_, i) => 1.5 + 0.2 * i);

/** One row for each way of choosing R, over all views of all clouds with known truth. */
export function scoreRadiusChoices(): Table {
  const bunny = bunny36k();
  const clouds: [string, Cloud | undefined][] = [
    ["dragon_res2", dragon("dragon_res2")],
    ["dragon_res3", dragon("dragon_res3")],
    ["stanford-bunny", bunny],
  ];
  const scores = new Map<string, { error: number; ratio: number }[]>();
  for (const [name, cloud] of clouds) {
    const json = sharedFile("truth", `${name}.json`);
    const labels = sharedFile("truth", `${name}.u8.gz`);
    if (cloud === undefined || json === undefined || labels === undefined) continue;
    const truth = JSON.parse(readFileSync(json, "utf8")) as Truth;
    const bytes = gunzipSync(readFileSync(labels));
    const points = new PointCloud(cloud.positions);
    truth.views.forEach(({ viewpoint }, view) => {
      const expected = bytes.subarray(view * points.length, (view + 1) * points.length);
      const error = (options: VisibilityOptions): number => {
        const mask = points.visibleFrom(viewpoint, options).mask();
        return (mask.reduce((wrong, seen, i) => wrong + (seen === expected[i] ? 0 : 1), 0) / mask.length) * 100;
      };
      const best = Math.min(...SCAN.map((exponent) => error({ exponent })));
      const note = (choice: string, options: VisibilityOptions): void => {
        const value = error(options);
        scores.set(choice, [...(scores.get(choice) ?? []), { error: value, ratio: value / best }]);
      };
      note("automatic", {});
      for (const exponent of [2, 2.5, 3, 3.5, 4]) note(`exponent ${exponent}`, { exponent });
      note("R = 100 × box diagonal", { radius: 100 * truth.bbox_diagonal });
    });
    points.dispose();
  }
  const rows = [...scores].map(([choice, views]) => {
    const ratios = views.map(({ ratio }) => ratio).toSorted((a, b) => a - b);
    return {
      "choice of R": choice,
      views: views.length,
      "mean error %": views.reduce((sum, { error }) => sum + error, 0) / views.length,
      "÷ best R: mean": ratios.reduce((sum, ratio) => sum + ratio, 0) / ratios.length,
      median: median(ratios),
      worst: ratios.at(-1) ?? NaN,
    };
  });
  const note =
    "False positives plus false negatives, in % of all points, and how many times the error of the best R of each view that is.";
  return { title: "Error against ray-traced visibility", note, rows };
}
