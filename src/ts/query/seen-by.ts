import type { Found, Photographed } from "./answers.js";
import { HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { MAX_LENGTH } from "./positions.js";
import { SurveyTask } from "./surveys.js";

/**
 * Which cameras see each point, and where: the rows of a sparse matrix. The cameras of point i are
 * `cameras[offsets[i]]` to `cameras[offsets[i + 1] − 1]`, ascending. Entry k has the pixel
 * `pixels[2k]`, `pixels[2k + 1]`, and the direction of length 1 from the point to the camera is `towards[3k]` to
 * `towards[3k + 2]`. All arrays are the caller's own copies.
 */
export interface SeenBy {
  /** One number more than the cloud has indices. */
  offsets: Uint32Array<ArrayBuffer>;
  cameras: Uint32Array<ArrayBuffer>;
  pixels: Float32Array<ArrayBuffer>;
  towards: Float32Array<ArrayBuffer>;
  /** What is probably wrong with a camera; see `Visibility.note`. */
  note?: string;
}

/** Collects what each camera sees. The memory is that of the answer, twice. */
export class SeenByTask extends SurveyTask<SeenBy> {
  readonly #views = new Map<number, { indices: Uint32Array; pixels: Float32Array; towards: Float32Array }>();

  protected override add(number: number, found: Found): void {
    const { indices, pixels, towards } = found as Required<Photographed>;
    this.#views.set(number, { indices, pixels, towards });
  }

  protected override more(): number[] {
    return [];
  }

  /** @param length the length of the cloud */
  result(length: number): SeenBy {
    const count = [...this.#views.values()].reduce((sum, { indices }) => sum + indices.length, 0);
    if (3 * count > MAX_LENGTH) {
      throw new HprError("too-large", `${3 * count} numbers exceed the limit of ${MAX_LENGTH}`);
    }
    return allocating(`${count} entries`, () => {
      const offsets = new Uint32Array(length + 1);
      for (const { indices } of this.#views.values()) for (const index of indices) offsets[index + 1]! += 1;
      for (let i = 0; i < length; i++) offsets[i + 1]! += offsets[i]!;
      const next = offsets.slice(0, length);
      const cameras = new Uint32Array(count);
      const [pixels, towards] = [new Float32Array(2 * count), new Float32Array(3 * count)];
      for (let number = 0; number < this.count; number++) {
        const view = this.#views.get(number);
        view?.indices.forEach((index, i) => {
          const at = next[index]!++;
          cameras[at] = number;
          for (let axis = 0; axis < 2; axis++) pixels[2 * at + axis] = view.pixels[2 * i + axis]!;
          for (let axis = 0; axis < 3; axis++) towards[3 * at + axis] = view.towards[3 * i + axis]!;
        });
      }
      return { offsets, cameras, pixels, towards, ...this.noted };
    });
  }
}
