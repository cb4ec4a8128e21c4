/// <reference lib="esnext.disposable" preserve="true" />
import { addDisposeSymbol, addTag } from "../base/objects.js";
import { HprError } from "../base/errors.js";
import { type Bindings, type Instance, requireInstance } from "../instance/instance.js";
import { type Positions, readPositions, readViewpoint, type Viewpoint } from "../query/positions.js";
import { freeCloud, unreachable } from "../instance/engine.js";
import { type MergeOptions, mergeSettings } from "./merge.js";

/**
 * The hull of some points of a cloud, as seen from one viewpoint. It shows which other points and
 * boxes are hidden, wherever they are stored: in tiles, on servers, not yet loaded.
 *
 * Hidden points stay hidden when points are added. So a horizon of a sample screens the rest of the
 * cloud, part by part. {@link mergeVisible} then answers exactly for the points that are left.
 */
export class Horizon {
  /** The same as {@link Horizon.dispose}, on platforms that have `Symbol.dispose`. */
  declare readonly [Symbol.dispose]: () => void;

  readonly #instance: Instance;
  #handle: number | undefined;

  static {
    addDisposeSymbol(this.prototype);
    addTag(this.prototype, "Horizon");
  }

  /**
   * Makes a horizon without points, which hides nothing.
   *
   * @param viewpoint x, y, z in the units of the whole cloud.
   * @param options as for {@link mergeVisible}: the radius or the inversion is a number, the same for
   *   all parts of the cloud.
   * @throws HprError `not-initialised`, `viewpoint`, `radius`, `option`, `too-large`, `internal`.
   */
  constructor(viewpoint: Viewpoint, options: MergeOptions) {
    const instance = requireInstance();
    const [x, y, z] = readViewpoint(viewpoint, 3) as [number, number, number];
    const settings = mergeSettings(options, "the whole cloud is seen with");
    const { handle } = instance.call((bindings) => bindings.createHorizon(x, y, z, settings));
    this.#instance = instance;
    this.#handle = handle;
    unreachable.register(this, { instance, handle }, this);
  }

  /**
   * Adds points: x, y, z of one after another. Then the horizon hides what all points so far hide
   * together. It keeps only those that are visible among them. If the points are refused, the horizon
   * stays as it was.
   *
   * @throws HprError `positions-type`, `positions-length`, `non-finite`, `radius` (a point is farther
   *   than the radius), `too-large`, `disposed`, `internal`.
   */
  add(positions: Positions): void {
    this.#call(positions, (bindings, handle, numbers) => bindings.append(handle, numbers));
  }

  /**
   * Finds the points that the horizon does not hide.
   *
   * @returns their numbers in the list of points, ascending. A point is listed exactly if it would be
   *   visible after it was added alone. All others are hidden in every cloud with the horizon's points.
   * @throws HprError as {@link Horizon.add}.
   */
  screen(positions: Positions): Uint32Array {
    return this.#call(positions, (bindings, handle, numbers) => bindings.screen(handle, numbers));
  }

  /**
   * Whether every point in a box, borders included, is hidden. `true` is certain. `false` may also be
   * the answer for a hidden box.
   *
   * @param min the least x, y, z.
   * @param max the largest x, y, z.
   * @throws HprError `option` (not finite, or a minimum above its maximum), `disposed`, `internal`.
   */
  hidesBox(min: Viewpoint, max: Viewpoint): boolean {
    const corners = readBox(min, max);
    const handle = this.#requireHandle();
    return this.#instance.call((bindings) => bindings.hidesBox(handle, corners));
  }

  /**
   * The points of the horizon: x, y, z of each added point that no other added point hides. A horizon
   * of these points hides the same. So only they have to be sent to other workers or machines.
   *
   * @throws HprError `too-large`, `disposed`, `internal`.
   */
  visible(): Float64Array {
    const handle = this.#requireHandle();
    return this.#instance.call((bindings) => bindings.horizonPoints(handle));
  }

  /** Frees the memory. May be called twice. */
  dispose(): void {
    const handle = this.#handle;
    if (handle !== undefined) {
      this.#handle = undefined;
      unreachable.unregister(this);
      freeCloud({ instance: this.#instance, handle });
    }
  }

  #call<T>(
    positions: unknown,
    use: (bindings: Bindings, handle: number, numbers: Float32Array | Float64Array) => T,
  ): T {
    this.#requireHandle();
    const numbers = readPositions(positions, 3);
    // Getters of the positions may have disposed of the horizon.
    const handle = this.#requireHandle();
    return this.#instance.call((bindings) => use(bindings, handle, numbers));
  }

  #requireHandle(): number {
    if (this.#handle === undefined) {
      throw new HprError("disposed", "this horizon has been disposed of");
    }
    return this.#handle;
  }
}

/**
 * The corners of a box. The core checks that they are finite and in order.
 *
 * @throws HprError `option`.
 */
export function readBox(min: Viewpoint, max: Viewpoint): Float64Array<ArrayBuffer> {
  return Float64Array.from([...readCorner(min, "min"), ...readCorner(max, "max")]);
}

function readCorner(corner: Viewpoint, name: string): number[] {
  try {
    return readViewpoint(corner, 3, name);
  } catch (cause) {
    throw cause instanceof HprError ? new HprError("option", cause.message, { cause }) : cause;
  }
}
