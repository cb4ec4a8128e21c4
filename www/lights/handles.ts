import { lightByKey } from "./moves.ts";
import type { Store } from "../settings/store.ts";
import type { Viewer } from "../view/viewer.ts";
import { placeAt, project } from "../view/place.ts";

/** A handle over the picture for each light. The user drags it, or moves it around the cloud by keys. */
export class LightHandles {
  readonly #container: HTMLElement;
  readonly #viewer: Viewer;
  readonly #store: Store;

  constructor(container: HTMLElement, viewer: Viewer, store: Store) {
    this.#container = container;
    this.#viewer = viewer;
    this.#store = store;
    store.follow(({ lights }) => {
      while (this.#handles.length > lights.length) this.#handles.at(-1)!.remove();
      for (let i = this.#handles.length; i < lights.length; i++) container.append(this.#handle(i));
      this.place();
    });
  }

  /** Moves the handles to their lights. A light outside the picture has no handle. */
  place(): void {
    const { lights } = this.#store.current;
    const { width, height } = this.#viewer.stage.size;
    for (const [i, handle] of this.#handles.entries()) {
      const at = this.#viewer.cloud && project(this.#viewer, lights[i]!);
      const inPicture = at && at.x >= 0 && at.y >= 0 && at.x <= width && at.y <= height;
      handle.hidden = !inPicture;
      if (inPicture) handle.style.translate = `${at.x}px ${at.y}px`;
    }
  }

  get #handles(): HTMLButtonElement[] {
    return [...this.#container.children] as HTMLButtonElement[];
  }

  #handle(i: number): HTMLButtonElement {
    const handle = document.createElement("button");
    handle.type = "button";
    handle.textContent = String(i + 1);
    handle.ariaLabel = `Light ${i + 1}: drag it, or move it with the arrow keys, plus and minus`;
    handle.addEventListener("keydown", (event) => {
      lightByKey(event, i, this.#store, this.#viewer);
    });
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
    });
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const { left, top, width, height } = this.#container.getBoundingClientRect();
      const lights = [...this.#store.current.lights];
      // The handle stays in the picture: outside it, nobody could drag it back.
      const [x, y] = [clamp(event.clientX - left, width), clamp(event.clientY - top, height)];
      lights[i] = placeAt(this.#viewer, x, y, lights[i]!);
      this.#store.change({ lights });
    });
    return handle;
  }
}

/** A value between 0 and a length, with some distance from the ends. */
function clamp(value: number, length: number): number {
  return Math.min(length - 8, Math.max(8, value));
}
