// Figure 7 of the paper in numbers: errors against R, and the R that each rule chooses.
import { PointCloud } from "hidden-point-removal";

import { bounds } from "../bench/views.js";
import { AUTOMATIC, type Method, PAPERS_RULE } from "./methods.js";
import { type Errors, errorsOf } from "./score.js";
import type { Labelled } from "./truth.js";

/** Errors at R = farthest distance · 10^exponent. */
export interface AtRadius extends Errors {
  exponent: number;
}

export interface Curve {
  name: string;
  points: number;
  views: number;
  /** The errors, in the order of rising R. */
  errors: AtRadius[];
  /** The R that each rule chose, and its errors. */
  rules: (AtRadius & { rule: string })[];
}

export const EXPONENTS = Array.from({ length: 37 }, (_, i) => 1 + i / 8);

/** Returns one curve for each view. */
export function curves({ name, positions, views }: Labelled, exponents = EXPONENTS): Curve[] {
  const { center, radius } = bounds({ positions });
  const cloud = new PointCloud(positions);
  try {
    return views.map(({ viewpoint, seen }) => {
      const by = ({ name: rule, ask }: Method) => {
        const visibility = ask({ cloud, positions, viewpoint, middle: center, diagonal: 2 * radius });
        return { rule, exponent: visibility.exponent, ...errorsOf(visibility.mask(), seen) };
      };
      const at = (exponent: number) => ({
        exponent,
        ...errorsOf(cloud.visibleFrom(viewpoint, { exponent }).mask(), seen),
      });
      return {
        name,
        points: cloud.length,
        views: 1,
        errors: exponents.map(at),
        rules: [AUTOMATIC, PAPERS_RULE].map(by),
      };
    });
  } finally {
    cloud.dispose();
  }
}

/** The means over the views: the errors at each exponent, and each rule's R and errors. */
export function meanCurve(all: Curve[]): Curve {
  const [first] = all;
  if (first === undefined) throw new Error("There is no view to take the mean of.");
  const mean = <T extends AtRadius>(like: T, pick: (curve: Curve) => AtRadius): T => {
    const picked = all.map(pick);
    const of = (key: keyof AtRadius) => picked.reduce((sum, item) => sum + item[key], 0) / picked.length;
    return {
      ...like,
      exponent: of("exponent"),
      falsePositives: of("falsePositives"),
      falseNegatives: of("falseNegatives"),
      total: of("total"),
    };
  };
  return {
    ...first,
    views: all.reduce((sum, { views }) => sum + views, 0),
    errors: first.errors.map((like, i) => mean(like, ({ errors }) => errors[i]!)),
    rules: first.rules.map((like, i) => mean(like, ({ rules }) => rules[i]!)),
  };
}
