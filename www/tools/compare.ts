import { AgainstPicture } from "../compare/against-picture.ts";
import { AgainstSurface } from "../compare/against-surface.ts";
import { byId } from "../controls/dom.ts";
import { pressed } from "../controls/keys.ts";
import { MIDDLE } from "../settings/limits.ts";
import type { Settings } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";
import type { Viewer } from "../view/viewer.ts";
import { CompareCard, type Sides } from "./compare-card.ts";

/** Shares of the width, in the order of the keys: left, right, down, up, page down, page up, home, end. */
const STEPS = [-0.02, 0.02, -0.02, 0.02, -0.1, 0.1, -1, 1];

/** The line that divides the picture: the reference is to its left, our answer is to its right. */
export class Compare {
  readonly #viewer: Viewer;
  readonly #store: Store;
  readonly #divider = byId("divider");
  readonly #note = byId("compare-note");
  readonly #card: CompareCard;
  /** `null` for a comparison with all points. */
  #reference: AgainstPicture | AgainstSurface | null = null;

  constructor(viewer: Viewer, store: Store) {
    this.#viewer = viewer;
    this.#store = store;
    this.#card = new CompareCard(store, () => {
      if (!(this.#reference instanceof AgainstSurface)) return;
      if (this.#reference.stopped) this.#reference.again();
      else this.#reference.stop();
    });
    const button = byId("tool-compare");
    button.addEventListener("click", () => {
      this.toggle();
    });
    this.#bindDivider();
    store.follow((now, before) => {
      button.setAttribute("aria-pressed", String(now.compare !== null));
      if (now.against !== before.against || (now.compare === null) !== (before.compare === null)) this.drop();
      this.follow();
    });
  }

  toggle(): void {
    this.#store.change({ compare: this.#store.current.compare === null ? MIDDLE : null });
  }

  /** Drops the reference: another cloud or another comparison is about to come. */
  drop(): void {
    this.#reference?.dispose();
    this.#reference = null;
    this.#viewer.showParts(null);
  }

  /** Updates the words on both sides. */
  follow(): void {
    const { compare } = this.#store.current;
    const idle = compare === null || this.#viewer.cloud === null;
    this.#divider.hidden = this.#note.hidden = idle;
    this.#card.show(idle ? null : this.#viewer.scene.surface);
    if (idle) return;
    const [left, right] = this.#note.children;
    const sides = this.#sides();
    left!.textContent = sides.left;
    right!.textContent = sides.right;
    this.#note.style.setProperty("--at", `${100 * compare}%`);
    this.#divider.style.left = `${100 * compare}%`;
    this.#divider.ariaValueNow = String(Math.round(100 * compare));
    this.#divider.ariaValueText = `${sides.left} on the left ${this.#divider.ariaValueNow} %, ${sides.right} on the right`;
  }

  /** Called every frame. */
  place(): void {
    if (this.#viewer.cloud === null) return;
    const { current } = this.#store;
    if (current.compare === null) return;
    this.#reference ??= this.#begin(current);
    this.#reference?.follow(current);
  }

  #begin({ against }: Settings): AgainstPicture | AgainstSurface | null {
    const { surface } = this.#viewer.scene;
    const changed = () => {
      this.follow();
    };
    if (against === "zbuffer") return new AgainstPicture(this.#viewer, changed);
    return against === "surface" && typeof surface !== "string"
      ? new AgainstSurface(this.#viewer, surface, changed)
      : null;
  }

  #sides(): Sides {
    return this.#compared(this.#viewer.scene.cloud.count) ?? { left: "All points", right: "Seen from here" };
  }

  /** Shows the figures; `null` as long as there are none. */
  #compared(total: number): Sides | null {
    if (this.#reference instanceof AgainstPicture) return this.#card.showPicture(this.#reference);
    if (this.#reference instanceof AgainstSurface) return this.#card.showSurface(this.#reference, total);
    this.#card.showAll();
    return null;
  }

  #bindDivider(): void {
    const divider = this.#divider;
    const moveTo = (share: number) => {
      this.#store.change({ compare: Math.min(1, Math.max(0, share)) });
    };
    divider.addEventListener("pointerdown", (event) => {
      divider.setPointerCapture(event.pointerId);
    });
    divider.addEventListener("pointermove", (event) => {
      if (!divider.hasPointerCapture(event.pointerId)) return;
      const { left, width } = divider.parentElement!.getBoundingClientRect();
      moveTo((event.clientX - left) / width);
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
