import type { Bindings } from "../instance/instance.js";
import type { Answers } from "../query/answers.js";
import type { Query, QueryKind } from "../query/queries.js";
import { HeldCloud } from "./held-cloud.js";
import { perform } from "./perform.js";

/** The number of points in a slice of a view. A slice takes some 5 to 10 ms. */
const SLICE = 40_000;

/**
 * A cloud in the memory of the wasm. Its queries were read and checked before, maybe in another
 * thread. `PointCloud` adds the methods that a user calls. A worker needs only this class.
 */
export class CoreCloud extends HeldCloud<Bindings> {
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
