import { describe, HprError } from "./errors.js";
import { allocating } from "./memory.js";

/** How a radius was chosen. */
export interface ChosenRadius {
  /**
   * R, the radius of the flipping sphere in the cloud's units; 0 where no point
   * is away from the viewpoint.
   */
  readonly radius: number;
  /** log₁₀(R ÷ farthest distance), the paper's parameter. */
  readonly exponent: number;
  /** Hulls computed to choose R, the final one not counted. */
  readonly evaluations: number;
}

/** Which points are visible from one viewpoint. */
export interface Visibility extends ChosenRadius {
  /** The visible points' indices, ascending: the caller's own copy. */
  readonly indices: Uint32Array;
  /** How many points are visible. */
  readonly count: number;
  /** The kernel that flipped the points. */
  readonly inversion: "spherical";
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

/** The answer to one query: numbers in JavaScript's own memory, with no tie to the wasm. */
export class VisibilityAnswer implements Visibility {
  readonly indices: Uint32Array;
  readonly count: number;
  readonly radius: number;
  readonly exponent: number;
  readonly evaluations: number;
  readonly inversion = "spherical";
  readonly #cloudLength: number;

  constructor(answer: ChosenRadius & { readonly indices: Uint32Array }, cloudLength: number) {
    this.indices = answer.indices;
    this.count = answer.indices.length;
    this.radius = answer.radius;
    this.exponent = answer.exponent;
    this.evaluations = answer.evaluations;
    this.#cloudLength = cloudLength;
  }

  mask(): Uint8Array {
    const length = this.#cloudLength;
    const mask = allocating(`a mask of ${length} bytes`, () => new Uint8Array(length));
    this.#mark(mask);
    return mask;
  }

  maskInto(target: Uint8Array): void {
    if (!(target instanceof Uint8Array) || target.length < this.#cloudLength) {
      throw tooShort("maskInto", "a Uint8Array", this.#cloudLength, target);
    }
    target.fill(0, 0, this.#cloudLength);
    this.#mark(target);
  }

  indicesInto(target: Uint32Array): number {
    if (!(target instanceof Uint32Array) || target.length < this.count) {
      throw tooShort("indicesInto", "a Uint32Array", this.count, target);
    }
    target.set(this.indices);
    return this.count;
  }

  #mark(mask: Uint8Array): void {
    for (const index of this.indices) {
      mask[index] = 1;
    }
  }
}

function tooShort(method: string, type: string, length: number, target: unknown): HprError {
  const got = ArrayBuffer.isView(target)
    ? `${describe(target)} and length ${String((target as Uint8Array).length)}`
    : describe(target);
  return new HprError("option", `${method} needs ${type} of at least ${length} elements, got ${got}`);
}
