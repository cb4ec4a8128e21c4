import { allocating } from "../base/memory.js";

/** How hidden points are drawn. */
export interface HiddenSettings {
  /** Whether they are drawn, but dimmed. */
  dim: boolean;
  /** Whether the dimming follows the scores. */
  dimsByScore: boolean;
  /** The least score of a point that is drawn as visible. Undefined: the answer itself decides. */
  threshold: number | undefined;
}

/** The share of its opacity that a hidden point keeps. */
export const DIMMED = 0.15;
/** Points with a higher score are more likely visible than hidden. */
const EVEN = 0.5;

/** The ascending indices of the points whose score is at least `threshold`. */
export function indicesOver(scores: Float32Array, threshold: number): Uint32Array {
  const indices = allocating(`${scores.length} indices`, () => new Uint32Array(scores.length));
  let count = 0;
  scores.forEach((score, index) => {
    if (score >= threshold) indices[count++] = index;
  });
  return indices.subarray(0, count);
}

/** How opaque each point of a geometry is while it is hidden, from 0 to 255. */
export class Shades {
  readonly opacities: Uint8Array;
  /** Grows with each change. */
  version = 0;
  #isEven = true;

  /** `length` is the number of the geometry's points. All are dimmed alike until there are scores. */
  constructor(length: number) {
    this.opacities = allocating(`${length} opacities`, () => new Uint8Array(length).fill(255 * DIMMED));
  }

  /**
   * The opacity grows with the score, up to 1 where points are drawn as visible: at `threshold`, or at
   * even chances if the answer itself decides. `ids` holds the number of each scored point. Without
   * scores, all points are dimmed alike.
   */
  take(scores: Float32Array | undefined, ids: Uint32Array | undefined, threshold = EVEN): void {
    if (scores === undefined) {
      if (!this.#isEven) {
        this.opacities.fill(255 * DIMMED);
        this.version += 1;
      }
      this.#isEven = true;
      return;
    }
    for (let i = 0; i < scores.length; i++) {
      const share = threshold > 0 ? Math.min(1, scores[i]! / threshold) : 1;
      this.opacities[ids === undefined ? i : ids[i]!] = Math.round(255 * (DIMMED + (1 - DIMMED) * share));
    }
    this.#isEven = false;
    this.version += 1;
  }
}
