// The methods that are compared: rules for R, other inversions, several viewpoints.
import { type PointCloud, ringOfViewpoints, type Visibility, type VisibilityOptions } from "hidden-point-removal";

import type { Point } from "../bench/measure.js";
import { zBuffered } from "./z-buffer.js";

export interface Subject {
  cloud: PointCloud;
  positions: Float32Array | Float64Array;
  viewpoint: Point;
  /** The target of a ring of viewpoints: the middle of the cloud. */
  middle: Point;
  /** The diagonal of the cloud's box. */
  diagonal: number;
}

export interface Method {
  name: string;
  /** How many hulls it takes: one for each viewpoint or look. Hulls that choose R are not counted. */
  hulls: number;
  ask: (subject: Subject) => Pick<Visibility, "mask" | "evaluations" | "exponent">;
}

const AROUND = 4;
const Z_BUFFER: Method = {
  name: "z-buffer of splats",
  hulls: 0,
  ask: ({ cloud, positions, viewpoint }) => ({
    mask: () => zBuffered(positions, viewpoint, cloud.spacing),
    evaluations: 0,
    exponent: 0,
  }),
};
const exponential: VisibilityOptions = { inversion: { exponential: "auto" } };

export const AUTOMATIC = one("automatic", {});
const LOOKS: Method = { ...one("three looks", { looks: 3 }), hulls: 3 };
const TWO_LOOKS: Method = { ...one("two looks", { looks: 2 }), hulls: 2 };
export const PAPERS_RULE = one("the paper's rule", { radius: "opposite" });

export const METHODS: Method[] = [
  AUTOMATIC,
  PAPERS_RULE,
  one("exp(c/d), automatic c", exponential),
  TWO_LOOKS,
  LOOKS,
  { name: "power as curved as automatic", hulls: 1, ask: asCurved },
  one("power 1.01", { inversion: { power: 1.01 } }),
  one("power 2", { inversion: { power: 2 } }),
  several("any of 5, exp(c/d)", ({ cloud }, ring) => cloud.visibleFromAny(ring, exponential)),
  several("at least 2 of 5, exp(c/d)", ({ cloud }, ring) => cloud.visibleFromAtLeast(2, ring, exponential)),
  several("at least 2 of 5, automatic", ({ cloud }, ring) => cloud.visibleFromAtLeast(2, ring)),
  ...[2, 3, 4].map((exponent) => one(`exponent ${exponent}`, { exponent })),
  {
    name: "R = 100 × box diagonal",
    hulls: 1,
    ask: ({ cloud, viewpoint, diagonal }) => cloud.visibleFrom(viewpoint, { radius: 100 * diagonal }),
  },
  Z_BUFFER,
];

export function one(name: string, options: VisibilityOptions): Method {
  return { name, hulls: 1, ask: ({ cloud, viewpoint }) => cloud.visibleFrom(viewpoint, options) };
}

function several(name: string, ask: (subject: Subject, ring: number[][]) => Visibility): Method {
  const ring = ({ viewpoint, middle }: Subject) => [
    viewpoint,
    ...ringOfViewpoints(viewpoint, middle, { count: AROUND }),
  ];
  return { name, hulls: AROUND + 1, ask: (subject) => ask(subject, ring(subject)) };
}

/**
 * The paper's other kernel. With its power, a surface that faces the viewer at distance r may be as curved as with
 * the automatic R: γ/((γ − 1)·r) = 2R/r².
 */
function asCurved({ cloud, viewpoint, middle }: Subject): Visibility {
  const r = Math.hypot(...viewpoint.map((x, axis) => x - middle[axis]!));
  const { radius } = cloud.autoRadius(viewpoint);
  return cloud.visibleFrom(viewpoint, { inversion: { power: 1 + r / (2 * radius - r) } });
}
