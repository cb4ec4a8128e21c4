import { type Action, pressed } from "../controls/keys.ts";
import type { Settings, Store } from "../settings/settings.ts";
import { HIDDEN_MODES } from "../settings/table.ts";
import type { Viewer } from "./viewer.ts";
import { isCalm } from "../controls/controls.ts";

/** The actions of keys and buttons on the picture. They are the same in the page and in an element. */
export class Moves {
  readonly #viewer: Viewer;
  readonly #store: Store;
  /** A reset goes back to these settings. */
  readonly #usual: () => Pick<Settings, "fieldOfView">;

  /** Also binds the keys of the canvas. */
  constructor(canvas: HTMLCanvasElement, viewer: Viewer, store: Store, usual: () => Pick<Settings, "fieldOfView">) {
    this.#viewer = viewer;
    this.#store = store;
    this.#usual = usual;
    const actions: Partial<Record<Action, () => void>> = {
      freeze: () => this.freeze(!this.frozen),
      reset: () => this.reset(),
      hidden: () => this.#nextHidden(),
    };
    const names = Object.keys(actions) as Action[];
    canvas.addEventListener("keydown", (event) => {
      const found = pressed(event, names);
      if (found) actions[found.action]!();
    });
  }

  get frozen(): boolean {
    return this.#store.current.freeze !== null;
  }

  /** Keeps the viewpoint in its place while the camera moves on, or lets it move with the camera again. */
  freeze(frozen: boolean): void {
    if (this.#viewer.cloud && frozen !== this.frozen) {
      this.#store.change({ freeze: frozen ? this.#viewer.viewpoint : null });
    }
  }

  /** Goes back to the first view of the cloud. */
  reset(): void {
    this.#store.change({ fieldOfView: this.#usual().fieldOfView });
    this.#viewer.reset();
  }

  #nextHidden(): void {
    const at = HIDDEN_MODES.indexOf(this.#store.current.hidden);
    this.#store.change({ hidden: HIDDEN_MODES[(at + 1) % HIDDEN_MODES.length]! });
  }
}

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
