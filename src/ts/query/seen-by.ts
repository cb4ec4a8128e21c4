import type { Found, Photographed } from "./answers.js";
import { HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { MAX_LENGTH } from "./positions.js";
import { SurveyTask } from "./surveys.js";

/**
 * Which cameras see each point, and where: the rows of a sparse matrix. The cameras of point i are
 * `cameras[offsets[i]]` to `cameras[offsets[i + 1] − 1]`, ascending. Entry k has the pixel
 * `pixels[2k]`, `pixels[2k + 1]`. All arrays are the caller's own copies.
 */
export interface SeenBy {
  /** One number more than the cloud has indices. */
  offsets: Uint32Array<ArrayBuffer>;
  cameras: Uint32Array<ArrayBuffer>;
  pixels: Float32Array<ArrayBuffer>;
}

/** Collects what each camera sees. The memory is that of the answer, twice. */
export class SeenByTask extends SurveyTask {
  readonly #views = new Map<number, { indices: Uint32Array; pixels: Float32Array }>();

  protected override add(number: number, found: Found): void {
    const { indices, pixels } = found as Photographed;
    // The memory of the indices is reused.
    this.#views.set(number, { indices: allocating(`${indices.length} indices`, () => indices.slice()), pixels });
  }

  protected override more(): number[] {
    return [];
  }

  /** @param length the length of the cloud */
  result(length: number): SeenBy {
    const count = [...this.#views.values()].reduce((sum, { indices }) => sum + indices.length, 0);
    if (2 * count > MAX_LENGTH) {
      throw new HprError("too-large", `${2 * count} numbers exceed the limit of ${MAX_LENGTH}`);
    }
    return allocating(`${count} entries`, () => {
      const offsets = new Uint32Array(length + 1);
      for (const { indices } of this.#views.values()) for (const index of indices) offsets[index + 1]! += 1;
      for (let i = 0; i < length; i++) offsets[i + 1]! += offsets[i]!;
      const next = offsets.slice(0, length);
      const [cameras, pixels] = [new Uint32Array(count), new Float32Array(2 * count)];
      for (let number = 0; number < this.count; number++) {
        const view = this.#views.get(number);
        view?.indices.forEach((index, i) => {
          const at = next[index]!++;
          cameras[at] = number;
          pixels[2 * at] = view.pixels[2 * i]!;
          pixels[2 * at + 1] = view.pixels[2 * i + 1]!;
        });
      }
      return { offsets, cameras, pixels };
    });
  }
}
