import { eased, isCalm, nextFrame } from "../controls/controls.ts";
import type { Store } from "../settings/settings.ts";
import { MIDDLE } from "../settings/limits.ts";
import type { Turning } from "../view/moves.ts";
import type { Viewer } from "../view/viewer.ts";

/** Milliseconds in which the line crosses the picture. */
const SWEEP = 2600;

/** Moves the line that divides the picture to a place, at once if motion is to be reduced or when `goes` says no. */
export async function sweep(store: Store, to: number, goes: () => boolean): Promise<void> {
  const from = store.current.compare ?? to;
  const begun = performance.now();
  while (goes() && !isCalm()) {
    const share = Math.min(1, (performance.now() - begun) / SWEEP);
    store.change({ compare: from + (to - from) * eased(share) });
    if (share === 1) return;
    await nextFrame();
  }
  // Whoever has put the line away does not want it back.
  if (store.current.compare !== null) store.change({ compare: to });
}

/**
 * The first sight of the page, for an address that asks for nothing: all points; a line sweeps over them and leaves
 * the visible ones; the picture turns. It ends when the user touches the page, and the line stays.
 */
export class Introduction {
  readonly #viewer: Viewer;
  readonly #store: Store;
  readonly #turning: Turning;
  readonly #introduces: boolean;
  #going: boolean;

  /** `introduces`: the address asks for nothing. */
  constructor(viewer: Viewer, store: Store, turning: Turning, introduces: boolean) {
    this.#viewer = viewer;
    this.#store = store;
    this.#turning = turning;
    this.#introduces = introduces;
    // The user may touch the page before this script has come. Old browsers do not tell.
    const { userActivation } = navigator as Partial<Navigator>;
    this.#going = introduces && userActivation?.hasBeenActive !== true;
    if (!introduces) return;
    store.change({ compare: isCalm() ? MIDDLE : 1 });
    for (const touch of ["pointerdown", "wheel", "keydown", "click"]) {
      document.addEventListener(touch, () => (this.#going = false), { once: true, capture: true, passive: true });
    }
  }

  /** Whether the page still shows what it showed by itself. Then the address says nothing of it. */
  get going(): boolean {
    return this.#going;
  }

  /** Begins when the first answer is drawn, and the line is there. */
  async begin(turns: boolean): Promise<void> {
    while (!this.#viewer.isFinal) await nextFrame();
    if (turns && (this.#going || !this.#introduces)) this.#turning.begin();
    // After an early touch the line is in the middle at once: where it stood before, all points are shown.
    if (this.#introduces && this.#store.current.compare === 1) await sweep(this.#store, MIDDLE, () => this.going);
  }
}
