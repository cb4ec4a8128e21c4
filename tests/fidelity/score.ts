// Compares answers with the truth.
import { PointCloud } from "hidden-point-removal";

import { bounds } from "../bench/views.js";
import type { Method, Subject } from "./methods.js";
import type { Labelled, View } from "./truth.js";

/** Errors in % of all points. */
export interface Errors {
  /** Hidden points that are called visible. */
  falsePositives: number;
  /** Visible points that are called hidden. */
  falseNegatives: number;
  total: number;
}

/** The result of one method for one view. */
export interface Score extends Errors {
  method: string;
  /** The total error divided by the error of the best R. */
  ratio?: number;
  hulls: number;
}

/** `mask` and `seen` have one byte for each point: 1 visible, 0 hidden. */
export function errorsOf(mask: Uint8Array, seen: Uint8Array): Errors {
  let [falsePositives, falseNegatives] = [0, 0];
  for (let i = 0; i < mask.length; i++) {
    if (mask[i]! > seen[i]!) falsePositives++;
    else if (mask[i]! < seen[i]!) falseNegatives++;
  }
  const percent = 100 / Math.max(mask.length, 1);
  return {
    falsePositives: percent * falsePositives,
    falseNegatives: percent * falseNegatives,
    total: percent * (falsePositives + falseNegatives),
  };
}

/**
 * Scores every view by every method. With `compared`, also compares the error with the error of the best R. That error
 * comes with the view or is found by scanning.
 */
export function score({ positions, views }: Labelled, methods: Method[], compared = true): Score[] {
  const { center, radius } = bounds({ positions });
  const cloud = new PointCloud(positions);
  try {
    return views.flatMap((view) => {
      const subject: Subject = { cloud, positions, viewpoint: view.viewpoint, middle: center, diagonal: 2 * radius };
      const best = compared ? (view.best ?? bestError(cloud, view)) : undefined;
      return methods.map((method) => {
        const visibility = method.ask(subject);
        const errors = errorsOf(visibility.mask(), view.seen);
        // Where the best R is never wrong, a ratio says nothing.
        const ratio = best === undefined || best === 0 ? {} : { ratio: errors.total / best };
        return { method: method.name, ...errors, ...ratio, hulls: method.hulls + visibility.evaluations };
      });
    });
  } finally {
    cloud.dispose();
  }
}

const COARSE = Array.from({ length: 21 }, (_, i) => 1 + 0.2 * i);
const FINE = [-0.15, -0.1, -0.05, 0.05, 0.1, 0.15];

/** The least error of all R. First tries exponents 0.2 apart, then exponents 0.05 apart around the best one. */
function bestError(cloud: PointCloud, { viewpoint, seen }: View): number {
  const error = (exponent: number): number => errorsOf(cloud.visibleFrom(viewpoint, { exponent }).mask(), seen).total;
  const errors = COARSE.map(error);
  const least = Math.min(...errors);
  const around = COARSE[errors.indexOf(least)]!;
  return Math.min(least, ...FINE.map((step) => error(around + step)));
}
