// Tests whether the scores of three looks are good probabilities.
import { PointCloud } from "hidden-point-removal";

import type { Row, Table } from "../bench/report.js";
import { calibrationError, rankedRight } from "./calibration.js";
import { lidarScenes } from "./lidar.js";
import type { Labelled } from "./truth.js";

const EXPLAINED =
  "Calibration error: the points are sorted into 20 bins of equal width by their score; the mean over all points of how far the " +
  "share of visible ones in a bin is from its mean score. AUC: how often a visible point has a higher score than a hidden one. " +
  "Lidar: the knowable points only.";

interface Known {
  viewpoint: readonly number[];
  seen: Uint8Array;
  unknowable?: Uint8Array;
}

/** One row for the scanned surfaces and one for simulated lidar, if they are available. */
export function scoreTables(scans: Labelled[], say: (message: string) => void): Table[] {
  say("Scoring the scores…");
  const rows = [...row("scanned surfaces", scans), ...row("simulated lidar", lidarScenes())];
  return rows.length === 0 ? [] : [{ title: "Scores of three looks", note: EXPLAINED, rows }];
}

function row(name: string, clouds: Iterable<{ positions: Labelled["positions"]; views: Known[] }>): Row[] {
  const scores: number[][] = [];
  const labels: number[][] = [];
  for (const { positions, views } of clouds) {
    const cloud = new PointCloud(positions);
    for (const { viewpoint, seen, unknowable } of views) {
      const answer = cloud.visibleFrom(viewpoint, { looks: 3, scores: true });
      const counts = (_: number, i: number) => unknowable?.[i] !== 1;
      scores.push(Array.from(answer.scores!.filter(counts)));
      labels.push(Array.from(seen.filter(counts)));
    }
    cloud.dispose();
  }
  if (scores.length === 0) return [];
  const all = { scores: Float64Array.from(scores.flat()), labels: Uint8Array.from(labels.flat()) };
  const each = scores.map((_, i) => rankedRight(Float64Array.from(scores[i]!), Uint8Array.from(labels[i]!)));
  return [
    {
      clouds: name,
      views: scores.length,
      "calibration error": calibrationError(all.scores, all.labels).toFixed(3),
      "AUC of all points": rankedRight(all.scores, all.labels).toFixed(3),
      "AUC, mean of views": (each.reduce((sum, auc) => sum + auc, 0) / each.length).toFixed(3),
    },
  ];
}
