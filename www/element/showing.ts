import type { TimedView } from "../view/inquiry.ts";
import type { Cloud } from "../cloud/cloud.ts";
import type { LoadRequest } from "../loaders/index.ts";
import { Moves } from "../view/moves.ts";
import { openCloud, type PreparedCloud } from "../open/open-cloud.ts";
import { addressOf, nameOf, requestForAddress, requestForSample, usableColor } from "../open/requests.ts";
import { sampleNamed } from "../samples/samples.ts";
import { type Settings, Store, USUAL_SETTINGS } from "../settings/settings.ts";
import { inReachOnly } from "../view/framing.ts";
import { project, Viewer } from "../view/viewer.ts";
import { type Frame, themeOf } from "./frame.ts";
import { changedSettings, Problem, problemOf, type Reading } from "./attributes.ts";
import { isKeyOf } from "../controls/keys.ts";
import { includes, pointAt } from "../tools/find.ts";
import { onClick, TOLERANCE } from "../tools/pointer.ts";
import type { PickedPoint, Place } from "./api.ts";

/** In sentences, a view that attributes ask for is the view "that is asked for". */
const ASKED = "that is asked for";

/** A showing calls these functions of its element. */
export interface Listener {
  loaded: (total: number, notes: string[]) => void;
  failed: (problem: Problem) => void;
  answered: (answer: TimedView) => void;
  progressed: (fraction: number | null) => void;
  /** Something is wrong, but there is a picture. */
  refused: (problem: Problem) => void;
  /** Keys have changed the settings. It is not called for attributes. */
  moved: (settings: Settings) => void;
}

/** The picture of an element, as long as the element is in a document. */
export class Showing {
  readonly viewer: Viewer;
  readonly canvas: HTMLCanvasElement;
  readonly moves: Moves;
  readonly #store: Store;
  readonly #frame: Frame;
  readonly #tell: Listener;
  #reading: Reading;
  #ready: PreparedCloud | null = null;
  #loading = new AbortController();
  #note: string | null = null;
  /** Whether the settings are being changed for the attributes. */
  #obeying = false;

  constructor(frame: Frame, canvas: HTMLCanvasElement, reading: Reading, tell: Listener) {
    this.#frame = frame;
    this.#tell = tell;
    this.#reading = reading;
    this.#store = new Store({ ...USUAL_SETTINGS, ...reading.settings });
    this.canvas = canvas;
    this.viewer = new Viewer(this.canvas, this.#store, true);
    this.viewer.setTheme(themeOf(this.canvas));
    this.moves = new Moves(this.canvas, this.viewer, this.#store, () => ({
      ...USUAL_SETTINGS,
      ...this.#ready?.usual,
      ...this.#reading.settings,
    }));
    this.viewer.onAnswer = (answer) => this.#hear(answer);
    this.viewer.onError = (error) => tell.refused(problemOf(error, "The view"));
    this.viewer.stage.onLost = () => {
      const problem = new Problem(
        "webgl",
        "The browser has taken this picture away to save memory; it is drawn again as soon as the browser allows.",
      );
      frame.sayError(problem.message);
      tell.refused(problem);
    };
    this.viewer.stage.onRestored = () => frame.sayError(null);
    this.#store.follow((now) => {
      if (this.#ready && !this.#obeying) tell.moved(now);
    });
  }

  /** The cloud that is shown. */
  get cloud(): Cloud | null {
    return this.viewer.cloud;
  }

  /** The attributes have changed. `look`: an attribute of the view was set, maybe to the same value again. */
  follow(reading: Reading, look: boolean): void {
    const before = this.#reading;
    this.#reading = reading;
    // A cloud that is being loaded follows the attributes later, when it is there.
    if (this.#ready) this.#apply(before, this.#ready, look);
  }

  /** Opens the cloud that the attributes name. It replaces the present cloud, even if that is still being loaded. */
  open(): void {
    this.#loading.abort();
    const { signal } = (this.#loading = new AbortController());
    this.#frame.sayError(null);
    const asked = this.#reading;
    const { src, sample } = asked;
    if (src === null && sample === null) {
      this.#empty();
      return;
    }
    const name = src === null ? sampleNamed(sample!).label : nameOf(src);
    if (!this.#ready) this.#frame.sayLoading(`Loading ${name}.`);
    this.#progress(null);
    this.#load(asked, name, signal).catch((error: unknown) => {
      if (signal.aborted) return;
      const problem = problemOf(error, name);
      this.#empty();
      this.#frame.sayError(problem.message);
      this.#tell.failed(problem);
    });
  }

  dispose(): void {
    this.#loading.abort();
    this.viewer.dispose();
    this.#frame.removeCanvas();
  }

  async #load(asked: Reading, name: string, signal: AbortSignal): Promise<void> {
    const sample = asked.src === null ? sampleNamed(asked.sample!) : null;
    const settings = { ...USUAL_SETTINGS, ...asked.settings };
    const ready = await openCloud(
      {
        request: sample ? requestForSample(sample, import.meta.url) : fileRequest(asked, name),
        sample,
        view: asked.view,
        settings: asked.settings,
      },
      {
        settings: () => settings,
        shape: () => this.viewer.stage.shape,
        asked: ASKED,
        shared: true,
        signal,
        onProgress: (step, fraction) => {
          if (signal.aborted) return;
          if (!this.#ready) this.#frame.sayLoading(step);
          this.#progress(fraction);
        },
      },
    );
    const { opened, refusals, notes } = ready;
    if (signal.aborted) {
      opened.inquiry.dispose();
      return;
    }
    this.#empty();
    this.#obey(() => {
      this.#store.change({ ...settings, ...ready.settings });
      this.viewer.show(opened);
      this.moves.freeze(asked.frozen);
    });
    this.#ready = ready;
    this.#apply(asked, ready, false);
    this.#tell.loaded(opened.cloud.count, notes);
    for (const refusal of refusals) this.#tell.refused(new Problem("attribute", refusal));
    this.#hear(opened.answer);
  }

  /** Applies the difference between the attributes before and the attributes now. */
  #apply(before: Reading, ready: PreparedCloud, look: boolean): void {
    const reading = this.#reading;
    const changed = changedSettings(before, reading, ready.usual);
    if (changed.color !== undefined) {
      const { color, notes } = usableColor(changed.color, ready.opened.cloud, true);
      for (const note of notes) this.#tell.refused(new Problem("attribute", note, { attribute: "color" }));
      changed.color = color;
    }
    this.#obey(() => {
      if (Object.keys(changed).length > 0) this.#store.change(changed);
      // Frozen before the camera goes to a new view, so that the old viewpoint stays.
      if (reading.frozen !== before.frozen) this.moves.freeze(reading.frozen);
      if (look || JSON.stringify(reading.view) !== JSON.stringify(before.view)) this.#look(ready);
    });
    this.viewer.stage.invalidate();
  }

  /** Goes to the view that is asked for. */
  #look(ready: PreparedCloud): void {
    const { view, notes } = inReachOnly(ready.opened.cloud, this.#reading.view, {}, ASKED);
    for (const note of notes) {
      this.#tell.refused(new Problem("attribute", note, { attribute: view ? "target" : "viewpoint" }));
    }
    this.viewer.setHome(ready.homeFrom(view));
  }

  #obey(change: () => void): void {
    this.#obeying = true;
    change();
    this.#obeying = false;
  }

  #hear(answer: TimedView): void {
    // The first answer is reported together with the cloud.
    if (!this.#ready) return;
    if (answer.note !== null && answer.note !== this.#note) this.#tell.refused(new Problem("attribute", answer.note));
    this.#note = answer.note;
    this.#tell.answered(answer);
  }

  #progress(fraction: number | null): void {
    this.#frame.showProgress(fraction);
    this.#tell.progressed(fraction);
  }

  #quiet(): void {
    this.#frame.hideProgress();
    this.#frame.sayLoading(null);
  }

  #empty(): void {
    this.#quiet();
    this.viewer.clear();
    this.#ready = null;
    this.#note = null;
  }
}

function fileRequest({ src, limit, skipNonFinite }: Reading, name: string): LoadRequest {
  if (!addressOf(src!)) throw new Problem("source", `${name} could not be downloaded: “${src}” is no address.`);
  return requestForAddress(src!, { skipNonFinite, ...(limit === undefined ? {} : { limit }) });
}

interface Options {
  through?: boolean;
  tolerance?: number;
}

/**
 * Finds the point at a place of the pointer, and the place of a point. Places are in client coordinates. Without a
 * cloud there are no points.
 */
export class Pointing {
  readonly #canvas: HTMLCanvasElement;
  readonly #viewer: Viewer;

  constructor(canvas: HTMLCanvasElement, viewer: Viewer) {
    this.#canvas = canvas;
    this.#viewer = viewer;
  }

  pick(clientX: number, clientY: number, { through = false, tolerance = TOLERANCE }: Options = {}): PickedPoint | null {
    if (![clientX, clientY, tolerance].every(Number.isFinite)) throw new TypeError("expected finite numbers");
    if (!this.#viewer.cloud) return null;
    const { left, top, scale } = this.#frame;
    const index = pointAt(
      this.#viewer,
      { x: (clientX - left) / scale, y: (clientY - top) / scale, tolerance },
      through,
    );
    return index === null ? null : this.#point(index);
  }

  project(position: Place): { x: number; y: number } | null {
    const at = this.#viewer.cloud && project(this.#viewer, position);
    const { left, top, scale } = this.#frame;
    return at && { x: left + at.x * scale, y: top + at.y * scale };
  }

  /** Calls `tell` for a visible point that is clicked. Enter counts as a click on the middle of the picture. */
  onPick(tell: (point: PickedPoint) => void): void {
    const at = (x: number, y: number, tolerance: number) => {
      const index = this.#viewer.cloud ? pointAt(this.#viewer, { x, y, tolerance }, false) : null;
      if (index !== null) tell(this.#point(index));
    };
    onClick(this.#canvas, ({ x, y, tolerance }) => {
      const { scale } = this.#frame;
      at(x / scale, y / scale, tolerance);
    });
    this.#canvas.addEventListener("keydown", (event) => {
      const { width, height } = this.#viewer.stage.size;
      if (isKeyOf("middle", event) && !event.repeat) at(width / 2, height / 2, TOLERANCE);
    });
  }

  /** Where the picture is, and its scale: the page may have scaled the element. */
  get #frame(): { left: number; top: number; scale: number } {
    const { left, top, width } = this.#canvas.getBoundingClientRect();
    return { left, top, scale: width / this.#canvas.clientWidth || 1 };
  }

  #point(index: number): PickedPoint {
    const { positions, visible } = this.#viewer.scene;
    const position = [0, 1, 2].map((axis) => positions[3 * index + axis]!) as Place;
    return { index, position, visible: includes(visible, index) };
  }
}
