import { type Action, pressed } from "../controls/keys.ts";
import type { Settings } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";
import { HIDDEN_MODES } from "../settings/table.ts";
import type { Viewer } from "./viewer.ts";

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
