import type { HiddenMode, Settings, Store } from "../settings/settings.ts";
import type { Viewer } from "./viewer.ts";

const FIELD_OF_VIEW = { least: 5, most: 100 };
const HIDDEN: readonly HiddenMode[] = ["off", "dimmed", "shown"];

/** What keys and buttons do to the picture, the same in the page and in an element. */
export class Moves {
  readonly #viewer: Viewer;
  readonly #store: Store;
  /** What a reset goes back to. */
  readonly #usual: () => Pick<Settings, "fieldOfView">;

  /** Also gives the canvas its keys, those of the navigation and `more` besides. */
  constructor(
    canvas: HTMLCanvasElement,
    viewer: Viewer,
    store: Store,
    usual: () => Pick<Settings, "fieldOfView">,
    more: Record<string, () => void> = {},
  ) {
    this.#viewer = viewer;
    this.#store = store;
    this.#usual = usual;
    viewer.navigation.onFieldOfView = (factor) => {
      const wanted = store.current.fieldOfView * factor;
      store.change({ fieldOfView: Math.min(FIELD_OF_VIEW.most, Math.max(FIELD_OF_VIEW.least, wanted)) });
    };
    const keys: Record<string, () => void> = {
      ...more,
      v: () => {
        this.freeze(!this.frozen);
      },
      r: () => {
        this.reset();
      },
      h: () => {
        this.#nextHidden();
      },
    };
    canvas.addEventListener("keydown", (event) => {
      if (!event.ctrlKey && !event.metaKey && !event.altKey) keys[event.key.toLowerCase()]?.();
    });
  }

  get frozen(): boolean {
    return this.#store.current.freeze !== null;
  }

  /** Keeps the viewpoint where it is while the camera moves on, or lets it go with the camera again. */
  freeze(frozen: boolean): void {
    if (this.#viewer.cloud && frozen !== this.frozen)
      this.#store.change({ freeze: frozen ? this.#viewer.viewpoint : null });
  }

  /** Looks at the cloud as for the first time. */
  reset(): void {
    this.#store.change({ fieldOfView: this.#usual().fieldOfView });
    this.#viewer.reset();
  }

  #nextHidden(): void {
    const at = HIDDEN.indexOf(this.#store.current.hidden);
    this.#store.change({ hidden: HIDDEN[(at + 1) % HIDDEN.length]! });
  }
}
