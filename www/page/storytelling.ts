import { byId, eased, isCalm, nextFrame } from "../controls/controls.ts";
import { SAMPLES } from "../samples/samples.ts";
import { readAddress } from "../settings/address.ts";
import { type Store, USUAL_SETTINGS } from "../settings/settings.ts";
import { STORIES, type StoryName } from "../settings/table.ts";
import type { Player } from "../stories/stories.ts";
import { inLocal } from "../view/framing.ts";
import type { Viewer } from "../view/viewer.ts";
import type { Opening, PageParts } from "./opening.ts";
import { type Source, sourceOf } from "./sources.ts";
import { MIDDLE } from "../settings/limits.ts";
import type { Turning } from "../view/moves.ts";

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

const SAMPLE_NAMES = SAMPLES.map(({ name }) => name);
/** Milliseconds in which the camera flies to the next step. */
const FLIGHT = 1500;
/** The field of view of a picture that is higher than wide: else the ends of a tape are out of it. */
const NARROW = "&fov=96";

/** The parts of the page that a story uses. */
type Used = Pick<PageParts, "viewer" | "store" | "address" | "workshop"> & { opening: Opening };

/**
 * Tells stories with the picture and the tools of the page. Their code is downloaded when the first one begins. A story is
 * an entry in the browser's history: its end goes back to the cloud that was open before.
 */
export class Storytelling {
  readonly #parts: Used;
  #player: Player | null = null;
  #isTelling = false;
  /** What was open before the story. `null`: the page began with the story, or another cloud has been opened. */
  #before: (() => Source) | null = null;

  constructor(parts: Used) {
    this.#parts = parts;
    // Another cloud ends the story.
    parts.opening.onOpen = ({ isTold }) => {
      if (isTold) return;
      this.#before = null;
      this.#player?.end();
    };
    addEventListener("popstate", () => {
      const before = this.#before;
      const { story } = readAddress(location.search, SAMPLE_NAMES);
      this.#player?.end();
      if (story) void this.tell(story);
      else if (before) void parts.opening.open(before());
    });
  }

  /** Whether the page shows what a story asks for. */
  get isTelling(): boolean {
    return this.#isTelling;
  }

  async tell(name: StoryName): Promise<void> {
    const { Player, TOLD } = await import("../stories/stories.ts");
    const { opening, viewer, store, address } = this.#parts;
    this.#player?.end();
    const { source } = opening;
    if (source && viewer.cloud) {
      address.link();
      const { search } = location;
      const view = viewer.isHome ? source.view : { at: viewer.viewpoint, target: viewer.target };
      const settings = store.current;
      this.#before = () => {
        const again = source.name ? sourceOf(readAddress(search, SAMPLE_NAMES), search) : { ...source, view };
        return { ...again, settings, notes: [] };
      };
    }
    this.#isTelling = true;
    address.tell(name, this.#before !== null);
    const lens = this.#parts.viewer.stage.shape.aspect < 1 ? NARROW : "";
    const player = (this.#player = new Player(TOLD[name], {
      show: (address, signal) => this.#show(`?sample=${STORIES[name]}&${address}${lens}`, signal),
      figure: (figure) => this.#parts.workshop.tools?.figure(figure) ?? null,
      ended: () => {
        if (this.#player !== player) return;
        this.#player = null;
        this.#isTelling = false;
        address.touch();
        byId("view").focus();
        if (this.#before && new URLSearchParams(location.search).has("story")) history.back();
        else this.#before = null;
      },
    }));
    player.begin(byId("stage"));
  }

  async #show(search: string, signal: AbortSignal): Promise<void> {
    const { viewer, store, opening, workshop } = this.#parts;
    const goes = () => !signal.aborted;
    const asked = readAddress(search, SAMPLE_NAMES);
    if (opening.shownName !== asked.sample || !viewer.cloud) {
      await opening.open({ ...sourceOf(asked, search), isTold: true });
      // The page has said why it could not be opened.
      if (opening.shownName === asked.sample || !goes()) return;
      this.#before = null;
      this.#player?.end();
    } else {
      const { theme, compare } = store.current;
      const to = { ...USUAL_SETTINGS, ...opening.usual, theme, ...asked.settings };
      // The line goes to its place after the marks are there.
      store.change({ ...to, compare: to.compare === null || compare === null ? to.compare : compare });
      const { view, target } = asked;
      if (view && target) {
        viewer.navigation.flyTo({ at: inLocal(viewer.cloud, view), target: inLocal(viewer.cloud, target) }, FLIGHT);
      }
      // The user's own move ends the flight, too.
      while (viewer.navigation.isFlying && goes()) await nextFrame();
      if (!goes()) return;
      workshop.clear();
      await workshop.begin(search);
      if (to.compare !== null && goes()) await sweep(store, to.compare, goes);
    }
    while (!viewer.isFinal && goes()) await nextFrame();
  }
}
