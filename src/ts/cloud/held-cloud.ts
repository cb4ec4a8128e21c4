import { HprError } from "../base/errors.js";
import type { Instance } from "../instance/engine.js";
import type { Bindings as AllBindings } from "../instance/instance.js";
import type { CloudSettings, CloudSize } from "../query/options.js";
import { packed, readIndices, readPositions, refuseMask } from "../query/positions.js";
import type { Answers, Query, QueryKind } from "../query/queries.js";
import type * as lite from "../lite/hpr_bg.js";
import { freeCloud, unreachable } from "../instance/engine.js";
import { perform } from "./perform.js";

/** The exports that every wasm has. */
export type OperatorBindings = Omit<typeof lite, "__wbg_set_wasm">;

/** A cloud's place: its number in an instance. */
interface Held<Bindings> {
  instance: Instance<Bindings>;
  handle: number;
}

/** A cloud of two or three dimensions in the memory of a wasm: it is made, asked, changed and freed. */
export class HeldCloud<Bindings extends OperatorBindings> {
  readonly settings: CloudSettings;
  #held: Held<Bindings> | undefined;
  #size: CloudSize;

  /**
   * @param progress is called with the share of the building that is done. It must not throw.
   * @throws HprError as the constructor of `PointCloud`.
   */
  constructor(
    instance: Instance<Bindings>,
    positions: unknown,
    settings: CloudSettings,
    progress?: (share: number) => void,
  ) {
    const numbers = readPacked(positions, settings);
    const choices = { skipNonFinite: settings.skipNonFinite, progress };
    this.settings = settings;
    const { handle, ...size } = instance.call((bindings) => bindings.createCloud(numbers, settings.dimension, choices));
    this.#held = { instance, handle };
    this.#size = size;
    unreachable.register(this, this.#held, this);
  }

  get dimension(): number {
    return this.settings.dimension;
  }

  get size(): CloudSize {
    return this.#size;
  }

  get isOpen(): boolean {
    return this.#held !== undefined;
  }

  /** @throws HprError `disposed`. */
  requireOpen(): Held<Bindings> {
    if (this.#held === undefined) {
      throw new HprError("disposed", "this cloud has been disposed of");
    }
    return this.#held;
  }

  /** @throws HprError as `PointCloud.append`. */
  append(positions: unknown): void {
    this.requireOpen();
    const numbers = readPacked(positions, this.settings);
    // Getters of the argument may have disposed of the cloud while it was read.
    const { instance, handle } = this.requireOpen();
    this.#size = instance.call((bindings) => bindings.append(handle, numbers));
  }

  /** @throws HprError as `PointCloud.remove`. */
  remove(indices: ArrayLike<number>): void {
    this.requireOpen();
    const integers = readIndices(indices);
    refuseMask(integers, this.size.length);
    const { instance, handle } = this.requireOpen();
    this.#size = instance.call((bindings) => bindings.remove(handle, integers));
  }

  /** May be called twice. */
  dispose(): void {
    if (this.#held !== undefined) {
      unreachable.unregister(this);
      freeCloud(this.#held);
      this.#held = undefined;
    }
  }
}

/** The number of points in a slice of a view. A slice takes some 5 to 10 ms. */
const SLICE = 40_000;

/**
 * A cloud in the memory of the wasm. Its queries were read and checked before, maybe in another
 * thread. `PointCloud` adds the methods that a user calls. A worker needs only this class.
 */
export class CoreCloud extends HeldCloud<AllBindings> {
  /** @throws HprError as the methods of `PointCloud`. */
  ask<K extends QueryKind>(query: Query<K>): Answers[K] {
    const { dimension, size } = this;
    return perform({ ...this.requireOpen(), dimension, length: size.length }, query);
  }

  /**
   * Computes one slice of a view, which takes some milliseconds; after the first hull, a slice is a whole look.
   * Returns whether nothing is left to compute before `ask`.
   *
   * @throws HprError as the methods of `PointCloud`.
   */
  goOn({ viewpoint, settings }: Query<"visibleFrom">): boolean {
    const { instance, handle } = this.requireOpen();
    if (this.dimension > 3) {
      return true;
    }
    const [x, y, z] = viewpoint as [number, number, number];
    return instance.call((bindings) => bindings.goOn(handle, x, y, z, settings, SLICE));
  }
}

function readPacked(positions: unknown, { stride, dimension }: CloudSettings): Float32Array | Float64Array {
  return packed(readPositions(positions, stride), stride, dimension);
}
