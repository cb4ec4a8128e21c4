import type { Answers } from "../query/answers.js";
import { HprError } from "../base/errors.js";
import type { Instance } from "../instance/instance.js";
import type { CloudSettings, CloudSize } from "../query/options.js";
import { freeCloud, unreachable } from "./free.js";
import { coreOptions, perform } from "./perform.js";
import { packed, readIndices, readPositions } from "../query/positions.js";
import type { Query, QueryKind } from "../query/queries.js";
import { Spares } from "./spares.js";

/** The number of points in a slice of a view. A slice takes some 5 to 10 ms. */
const SLICE = 40_000;

/**
 * A cloud in the memory of the wasm. Its queries were read and checked before, maybe in another
 * thread. `PointCloud` adds the methods that a user calls. A worker needs only this class.
 */
export class CoreCloud {
  readonly #instance: Instance;
  readonly #settings: CloudSettings;
  #handle: number | undefined;
  #size: CloudSize;
  readonly #spares = new Spares();

  /**
   * @param progress is called with the share of the building that is done. It must not throw.
   * @throws HprError as the constructor of `PointCloud`.
   */
  constructor(instance: Instance, positions: unknown, settings: CloudSettings, progress?: (share: number) => void) {
    const numbers = readPacked(positions, settings);
    const choices = { skipNonFinite: settings.skipNonFinite, progress };
    const { handle, ...size } = instance.call((bindings) => {
      if (settings.dimension > 3) {
        return bindings.createHyperCloud(numbers as Float64Array, settings.dimension, choices);
      }
      return numbers.BYTES_PER_ELEMENT === 4
        ? bindings.createCloudF32(numbers as Float32Array, choices)
        : bindings.createCloudF64(numbers as Float64Array, choices);
    });
    this.#instance = instance;
    this.#settings = settings;
    this.#handle = handle;
    this.#size = size;
    unreachable.register(this, { instance, handle }, this);
  }

  get dimension(): number {
    return this.#settings.dimension;
  }

  get settings(): CloudSettings {
    return this.#settings;
  }

  get size(): CloudSize {
    return this.#size;
  }

  /** @throws HprError `disposed`. */
  requireOpen(): void {
    this.#requireHandle();
  }

  /** @throws HprError as the methods of `PointCloud`. */
  ask<K extends QueryKind>(query: Query<K>): Answers[K] {
    // Getters of the arguments may have disposed of the cloud while they were read.
    const handle = this.#requireHandle();
    const { dimension } = this.#settings;
    const { length } = this.#size;
    return perform({ instance: this.#instance, handle, dimension, length, spares: this.#spares }, query);
  }

  /**
   * Goes on from the draft of a view, if the last question was this draft, or with several looks.
   * Computes one slice, which takes some milliseconds; after the first hull, a slice is a whole look.
   * Returns whether nothing is left to compute before `ask`.
   *
   * @throws HprError as the methods of `PointCloud`.
   */
  goOn({ viewpoint, settings }: Query<"visibleFrom">): boolean {
    const handle = this.#requireHandle();
    if (this.dimension > 3) {
      return true;
    }
    const [x, y, z] = viewpoint as [number, number, number];
    return this.#instance.call((bindings) => bindings.goOn(handle, x, y, z, coreOptions(settings), SLICE));
  }

  /** @throws HprError as `PointCloud.append`. */
  append(positions: unknown): void {
    this.#requireHandle();
    const numbers = readPacked(positions, this.#settings);
    const handle = this.#requireHandle();
    this.#size = this.#instance.call((bindings) => {
      if (this.#settings.dimension > 3) {
        return bindings.appendHyper(handle, numbers as Float64Array);
      }
      return numbers.BYTES_PER_ELEMENT === 4
        ? bindings.appendF32(handle, numbers as Float32Array)
        : bindings.appendF64(handle, numbers as Float64Array);
    });
  }

  /** @throws HprError as `PointCloud.remove`. */
  remove(indices: ArrayLike<number>): void {
    this.#requireHandle();
    const integers = readIndices(indices);
    const handle = this.#requireHandle();
    this.#size = this.#instance.call((bindings) => bindings.remove(handle, integers));
  }

  /** Keeps memory for the indices of later answers. */
  keepMemory(buffer: ArrayBuffer | undefined): void {
    if (this.#handle !== undefined) {
      this.#spares.keep(buffer);
    }
  }

  /** May be called twice. */
  dispose(): void {
    this.#spares.clear();
    const handle = this.#handle;
    if (handle !== undefined) {
      this.#handle = undefined;
      unreachable.unregister(this);
      freeCloud({ instance: this.#instance, handle });
    }
  }

  #requireHandle(): number {
    if (this.#handle === undefined) {
      throw new HprError("disposed", "this cloud has been disposed of");
    }
    return this.#handle;
  }
}

function readPacked(positions: unknown, { stride, dimension }: CloudSettings): Float32Array | Float64Array {
  return packed(readPositions(positions, stride), stride, dimension);
}
