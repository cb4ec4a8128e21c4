import { byId } from "../controls/controls.ts";
import { pressed } from "../controls/keys.ts";
import { MIDDLE } from "../settings/limits.ts";
import type { Store } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";

/** Shares of the width, in the order of the keys: left, right, down, up, page down, page up, home, end. */
const STEPS = [-0.02, 0.02, -0.02, 0.02, -0.1, 0.1, -1, 1];

/** The words beside the line need this share of the width on either side. */
const BESIDE = 0.1;

/** The line that divides the picture: all points are to its left, the points that can be seen to its right. */
export class Compare {
  readonly #viewer: Viewer;
  readonly #store: Store;
  readonly #divider = byId("divider");
  readonly #note = byId("compare-note");
  #where = "from here";

  constructor(viewer: Viewer, store: Store) {
    this.#viewer = viewer;
    this.#store = store;
    const button = byId("tool-compare");
    button.addEventListener("click", () => this.toggle());
    this.#bindDivider();
    store.follow(({ compare, freeze }) => {
      this.#where = freeze ? "from the eye" : "from here";
      button.setAttribute("aria-pressed", String(compare !== null));
      this.follow();
    });
  }

  toggle(): void {
    this.#store.change({ compare: this.#store.current.compare === null ? MIDDLE : null });
  }

  /** Called when a cloud is there, too. */
  follow(): void {
    const { compare } = this.#store.current;
    const idle = compare === null || this.#viewer.cloud === null;
    this.#divider.hidden = idle;
    this.#note.hidden = idle || compare < BESIDE || compare > 1 - BESIDE;
    if (idle) return;
    this.#note.style.setProperty("--at", `${100 * compare}%`);
    this.#divider.style.left = `${100 * compare}%`;
    this.#note.lastElementChild!.textContent = `Seen ${this.#where}`;
    const percent = String(Math.round(100 * compare));
    this.#divider.ariaValueNow = percent;
    this.#divider.ariaValueText = `All points on the left ${percent} %, seen ${this.#where} on the right`;
  }

  #bindDivider(): void {
    const divider = this.#divider;
    const moveTo = (share: number) => this.#store.change({ compare: Math.min(1, Math.max(0, share)) });
    divider.addEventListener("pointerdown", (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener("pointermove", (event) => {
      if (!divider.hasPointerCapture(event.pointerId)) return;
      const { left, width } = divider.parentElement!.getBoundingClientRect();
      moveTo((event.clientX - left) / width);
    });
    // The wheel is for the picture, also over the line.
    divider.addEventListener("wheel", (event) => {
      event.preventDefault();
      byId("view").dispatchEvent(new WheelEvent(event.type, event));
    });
    divider.addEventListener("keydown", (event) => {
      const { compare } = this.#store.current;
      const found = pressed(event, ["divide"]);
      if (compare === null || !found) return;
      event.preventDefault();
      moveTo(compare + STEPS[found.nth]!);
    });
  }
}
