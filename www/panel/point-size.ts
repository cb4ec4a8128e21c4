import { Segmented } from "../controls/segmented.ts";
import { SMALL } from "../settings/limits.ts";
import type { Store } from "../settings/store.ts";

/** The choice between small points, which show what lies behind them, and points that touch. */
export class PointSize {
  readonly #store: Store;
  readonly #choice: Segmented<"small" | "touching">;
  #touching = 1;

  constructor(store: Store) {
    this.#store = store;
    this.#choice = new Segmented("points", (size) => store.change({ size: size === "small" ? SMALL : this.#touching }));
    store.follow(() => this.#show());
  }

  /** Takes the size with which the points of the cloud on screen touch. */
  set touching(size: number) {
    this.#touching = size;
    this.#show();
  }

  /** Another size, from the slider or the address, is neither of the two. */
  #show(): void {
    const { size } = this.#store.current;
    this.#choice.value = size === SMALL ? "small" : size === this.#touching ? "touching" : null;
  }
}
