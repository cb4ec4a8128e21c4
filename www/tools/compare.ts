import { byId } from "../panel/dom.ts";
import type { Store } from "../settings.ts";
import type { Viewer } from "../viewer.ts";

/** Beside the middle, where one takes hold of the cloud to turn it. */
const FIRST = 0.42;
/** Shares of the width for each press of a key. */
const STEP = 0.02;
const LEAP = 0.1;

const number = new Intl.NumberFormat("en-US");

/**
 * The line that divides the picture: all points to its left, those that are seen to its right. To `introduce` it, it is
 * there from the beginning until the camera moves for the first time.
 */
export class Compare {
  private readonly viewer: Viewer;
  private readonly store: Store;
  private readonly divider = byId("divider");
  private readonly note = byId("compare-note");
  private introducing: boolean;

  constructor(viewer: Viewer, store: Store, introduce: boolean) {
    this.viewer = viewer;
    this.store = store;
    this.introducing = introduce;
    if (introduce) store.change({ compare: FIRST });
    const button = byId("tool-compare");
    button.addEventListener("click", () => { this.toggle(); });
    this.bindDivider();
    store.follow(({ compare }) => {
      button.setAttribute("aria-pressed", String(compare !== null));
      this.follow();
    });
  }

  toggle(): void {
    this.introducing = false;
    this.store.change({ compare: this.store.current.compare === null ? FIRST : null });
  }

  /** Says once more what is on either side. */
  follow(): void {
    const { compare } = this.store.current;
    this.divider.hidden = this.note.hidden = compare === null || this.viewer.cloud === null;
    if (compare === null || this.viewer.cloud === null) return;
    const { cloud, visible } = this.viewer.scene;
    const [left, right] = this.note.children;
    left!.textContent = `All ${number.format(cloud.count)} points`;
    right!.textContent = `${number.format(visible.length)} seen from here`;
    this.note.style.setProperty("--at", `${100 * compare}%`);
    this.divider.style.left = `${100 * compare}%`;
    this.divider.ariaValueNow = String(Math.round(100 * compare));
    this.divider.ariaValueText = `${left!.textContent} on the left ${this.divider.ariaValueNow} %, ${right!.textContent} on the right`;
  }

  /** Called every frame. */
  place(): void {
    if (!this.introducing || this.viewer.cloud === null || this.viewer.isHome) return;
    this.introducing = false;
    this.store.change({ compare: null });
  }

  private bindDivider(): void {
    const { divider } = this;
    const moveTo = (share: number) => { this.store.change({ compare: Math.min(1, Math.max(0, share)) }); };
    divider.addEventListener("pointerdown", (event) => { divider.setPointerCapture(event.pointerId); });
    divider.addEventListener("pointermove", (event) => {
      if (!divider.hasPointerCapture(event.pointerId)) return;
      const { left, width } = divider.parentElement!.getBoundingClientRect();
      moveTo((event.clientX - left) / width);
    });
    divider.addEventListener("keydown", (event) => {
      const { compare } = this.store.current;
      if (compare === null || event.ctrlKey || event.metaKey || event.altKey) return;
      const places: Record<string, number> = {
        ArrowLeft: compare - STEP,
        ArrowRight: compare + STEP,
        ArrowDown: compare - STEP,
        ArrowUp: compare + STEP,
        PageDown: compare - LEAP,
        PageUp: compare + LEAP,
        Home: 0,
        End: 1,
      };
      const place = places[event.key];
      if (place === undefined) return;
      event.preventDefault();
      moveTo(place);
    });
  }
}
