import { isCalm } from "../controls/motion.ts";
import type { Viewer } from "./viewer.ts";

/** Radians in a millisecond: a turn takes a minute. */
const SLOW = (2 * Math.PI) / 60_000;

/** What a user does to the page ends the turning. */
const TOUCHES = ["pointerdown", "wheel", "keydown"];

/** Turns the picture by itself until the user touches the page. If motion is to be reduced, it never begins. */
export class Turning {
  readonly #viewer: Viewer;
  #over: AbortController | null = null;

  constructor(viewer: Viewer) {
    this.#viewer = viewer;
  }

  get isOn(): boolean {
    return this.#over !== null;
  }

  /** `around`: turns once around the cloud, at this many times the usual speed. Default: goes on. */
  begin(around = 0): void {
    this.stop();
    if (isCalm()) return;
    const over = (this.#over = new AbortController());
    for (const touch of TOUCHES) {
      document.addEventListener(touch, () => this.stop(), { signal: over.signal, capture: true, passive: true });
    }
    let last = performance.now();
    let left = around > 0 ? 2 * Math.PI : Infinity;
    const step = (now: number) => {
      if (over.signal.aborted) return;
      // After a pause of the page, the picture goes on from where it was.
      const angle = Math.min(left, (around || 1) * SLOW * Math.min(100, Math.max(0, now - last)));
      last = now;
      if (this.#viewer.cloud) this.#viewer.navigation.turn(angle);
      left -= angle;
      if (left > 0) requestAnimationFrame(step);
      else this.stop();
    };
    requestAnimationFrame(step);
  }

  stop(): void {
    this.#over?.abort();
    this.#over = null;
  }
}
