import type { Answers, ChosenRadius, Found } from "../query/queries.js";
import { allocating, HprError } from "../base/errors.js";
import { addTag } from "../base/objects.js";
import { plainView } from "../base/typed-arrays.js";
import { INVERTED } from "../query/camera.js";
import type { ResolvedInversion } from "../query/view-options.js";

/**
 * The points that are visible from one or several viewpoints. The mask is made from `indices` at
 * each call, so a change of `indices` changes them. After the buffer of `indices` was
 * transferred away, `mask` throws an HprError `disposed`.
 */
export interface Visibility extends ChosenRadius {
  /** The indices of the visible points, ascending. This is the caller's own copy. */
  readonly indices: Uint32Array;
  /** How many points are visible. */
  readonly count: number;
  /**
   * How the points were flipped, with numbers only. With this inversion (and the radius, if it is not
   * exponential) as options, the points of any part of the cloud are flipped in the same way. With
   * `looks`, this holds the scale c of each look. That form is only information: it is not accepted as
   * an option.
   */
  readonly inversion: ResolvedInversion;
  /**
   * Whether this is the final answer to the question. It is false if all points of a cloud of four or more dimensions lie with the viewpoint in one flat, but for rounding that had to be removed.
   */
  readonly exact: boolean;
  /**
   * How likely it is that each point of the cloud is visible, from 0 to 1. Only with the option
   * `scores`. The score of removed and skipped points is 0. A visible point may have a score below ½,
   * and a hidden point a score above ½. This is the caller's own copy.
   */
  readonly scores?: Float32Array;
  /** What is probably wrong with a camera: its image holds next to none of the points, and that of the inverse pose many. */
  readonly note?: string;
  /** One byte for each point of the cloud: 1 visible, 0 hidden. */
  mask(): Uint8Array;
}

/** The answer to a question with the option `scores`, or without it. */
export type ScoredIf<Scores extends boolean> = Visibility &
  (Scores extends true ? { readonly scores: Float32Array } : unknown);

/** The visible points of a view, and the mesh between them. */
export interface Reconstruction extends Visibility {
  /**
   * Three indices for each triangle, counter-clockwise as seen from the viewpoint. The lowest index
   * stands for equal points. This is the caller's own copy.
   */
  readonly triangles: Uint32Array;
}

/** The visible points in the image of a camera. */
export interface CameraView extends Visibility {
  /** Where each visible point is in the image: x and y in pixels. This is the caller's own copy. */
  readonly pixels: Float32Array;
  /**
   * The depth of each visible point along the optical axis, in the cloud's units. This is the caller's
   * own copy.
   */
  readonly depths: Float32Array;
}

/** The answer to one query. Its numbers are in JavaScript's own memory, independent of the wasm. */
export class VisibilityAnswer implements Visibility {
  readonly indices: Uint32Array;
  readonly count: number;
  readonly radius: number;
  readonly exponent: number;
  readonly evaluations: number;
  readonly inversion: ResolvedInversion;
  readonly exact: boolean;
  declare readonly scores?: Float32Array;
  declare readonly note?: string;
  readonly #cloudLength: number;

  static {
    addTag(this.prototype, "Visibility");
  }

  constructor(answer: Found) {
    this.indices = answer.indices;
    this.count = answer.indices.length;
    this.radius = answer.radius;
    this.exponent = answer.exponent;
    this.evaluations = answer.evaluations;
    this.inversion = answer.inversion;
    this.exact = answer.exact;
    this.#cloudLength = answer.length;
    // Only its own: somebody may have added to Object.prototype.
    if (Object.hasOwn(answer, "scores") && answer.scores !== undefined) {
      this.scores = answer.scores;
    }
    if (Object.hasOwn(answer, "inverted") && answer.inverted === true) {
      this.note = INVERTED;
    }
  }

  mask(): Uint8Array {
    const length = this.#cloudLength;
    const indices = plainView(this.indices, Uint32Array);
    if (indices === undefined) {
      throw new HprError("disposed", "the indices of this answer are gone: they have been transferred away");
    }
    const mask = allocating(`a mask of ${length} bytes`, () => new Uint8Array(length));
    for (const index of indices) mask[index] = 1;
    return mask;
  }
}

export class ReconstructionAnswer extends VisibilityAnswer implements Reconstruction {
  readonly triangles: Uint32Array;

  constructor(answer: Answers["reconstruct"]) {
    super(answer);
    this.triangles = answer.triangles;
  }
}

export class CameraAnswer extends VisibilityAnswer implements CameraView {
  readonly pixels: Float32Array;
  readonly depths: Float32Array;

  constructor(answer: Answers["visibleFromCamera"]) {
    super(answer);
    this.pixels = answer.pixels;
    this.depths = answer.depths;
  }
}
