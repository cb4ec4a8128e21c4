import type { Answers, ChosenRadius, Found } from "../query/answers.js";
import { describe, HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import type { ResolvedInversion } from "../query/view-options.js";

/**
 * Which points are visible, from one viewpoint or several. The masks are made from `indices`
 * when they are asked for: what is written there shows in them, and once its
 * buffer has been recycled or transferred away the methods throw an HprError `disposed`.
 */
export interface Visibility extends ChosenRadius {
  /** The visible points' indices, ascending: the caller's own copy. */
  readonly indices: Uint32Array;
  /** How many points are visible. */
  readonly count: number;
  /**
   * How the points were flipped, with numbers only: asked with it (and with the radius,
   * if it is not exponential), any part of the cloud is flipped alike. With `looks` the
   * scale c of each look, which tells how the answer was found, but is no option.
   */
  readonly inversion: ResolvedInversion;
  /** Whether this is the final answer to what was asked: false only for drafts and samples. */
  readonly exact: boolean;
  /**
   * Only where the option `scores` asked for it: for each point of the cloud how likely it
   * is visible, from 0 to 1, and 0 for those removed and skipped. The caller's own copy. A
   * score need not be above ½ exactly where the point is visible; with `vote` it is that of
   * the answer before the vote.
   */
  readonly scores?: Float32Array;
  /** One byte for each point of the cloud: 1 visible, 0 hidden. */
  mask(): Uint8Array;
  /**
   * Writes the mask to the start of `target`, which must hold at least one byte
   * for each point of the cloud.
   *
   * @throws HprError `option` if it does not.
   */
  maskInto(target: Uint8Array): void;
  /**
   * Writes the indices to the start of `target`, which must hold at least
   * `count` numbers. Returns `count`.
   *
   * @throws HprError `option` if it does not.
   */
  indicesInto(target: Uint32Array): number;
}

/** What is visible from a viewpoint, as a mesh. */
export interface Reconstruction extends Visibility {
  /**
   * Three indices a triangle, counter-clockwise seen from the viewpoint; of equal points
   * the lowest index. The caller's own copy.
   */
  readonly triangles: Uint32Array;
}

/** The answer to one query: numbers in JavaScript's own memory, with no tie to the wasm. */
export class VisibilityAnswer implements Visibility {
  readonly indices: Uint32Array;
  readonly count: number;
  readonly radius: number;
  readonly exponent: number;
  readonly evaluations: number;
  readonly inversion: ResolvedInversion;
  readonly exact: boolean;
  declare readonly scores?: Float32Array;
  readonly #cloudLength: number;

  /**
   * Takes the memory of an answer's indices away from everybody who still looks at them.
   *
   * @throws HprError `option` for what is no answer of a cloud.
   */
  static takeMemory(answer: unknown): ArrayBuffer | undefined {
    if (typeof answer !== "object" || answer === null || !(#cloudLength in answer)) {
      throw new HprError("option", `recycle needs an answer of a cloud, got ${describe(answer)}`);
    }
    try {
      const { buffer } = answer.indices;
      return structuredClone(buffer as ArrayBuffer, { transfer: [buffer as ArrayBuffer] });
    } catch {
      // Gone already: recycled before, or transferred away.
      return undefined;
    }
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
    if (answer.scores !== undefined) {
      this.scores = answer.scores;
    }
  }

  mask(): Uint8Array {
    const length = this.#cloudLength;
    const indices = this.#readIndices();
    const mask = allocating(`a mask of ${length} bytes`, () => new Uint8Array(length));
    mark(mask, indices);
    return mask;
  }

  maskInto(target: Uint8Array): void {
    const bytes = typedArrayType(target) === "Uint8Array" ? plainView(target, Uint8Array) : undefined;
    if (bytes === undefined || bytes.length < this.#cloudLength) {
      throw tooShort("maskInto", "a Uint8Array", this.#cloudLength, target);
    }
    const indices = this.#readIndices();
    bytes.fill(0, 0, this.#cloudLength);
    mark(bytes, indices);
  }

  indicesInto(target: Uint32Array): number {
    const numbers = typedArrayType(target) === "Uint32Array" ? plainView(target, Uint32Array) : undefined;
    if (numbers === undefined || numbers.length < this.count) {
      throw tooShort("indicesInto", "a Uint32Array", this.count, target);
    }
    numbers.set(this.#readIndices());
    return this.count;
  }

  #readIndices(): Uint32Array {
    const indices = plainView(this.indices, Uint32Array);
    if (indices === undefined) {
      throw new HprError("disposed", "the indices of this answer are gone: recycled or transferred away");
    }
    return indices;
  }
}

export class ReconstructionAnswer extends VisibilityAnswer implements Reconstruction {
  readonly triangles: Uint32Array;

  constructor(answer: Answers["reconstruct"]) {
    super(answer);
    this.triangles = answer.triangles;
  }
}

function mark(mask: Uint8Array, indices: Uint32Array): void {
  for (const index of indices) {
    mask[index] = 1;
  }
}

function tooShort(method: string, type: string, length: number, target: unknown): HprError {
  const got =
    typedArrayType(target) === undefined
      ? describe(target)
      : `${describe(target)} and length ${(target as Uint8Array).length}`;
  return new HprError("option", `${method} needs ${type} of at least ${length} elements, got ${got}`);
}
