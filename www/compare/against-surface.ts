import type { TimedView } from "../ask/inquiry.ts";
import { Newest } from "../ask/newest.ts";
import { isSamePlace } from "../ask/question.ts";
import type { KnownSurface } from "../samples/samples.ts";
import type { Viewpoint } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import type { TruthAnswer, TruthQuestion } from "./protocol.ts";
import { Reference, sentenceOf } from "./reference.ts";

/** Milliseconds that the view has to rest before rays are traced. */
const REST = 300;

/** Our answer beside the truth. Rays are traced when the view rests. */
export class AgainstSurface {
  result: { truth: TruthAnswer; ours: TimedView } | null = null;
  problem: string | null = null;
  /** From 0 to 1 while rays are traced. */
  progress: number | null = null;
  stopped = false;
  readonly #viewer: Viewer;
  readonly #changed: () => void;
  readonly #surface: KnownSurface;
  readonly #worker: Reference<TruthQuestion, TruthAnswer>;
  readonly #origin: Viewpoint;
  readonly #newest = new Newest<TimedView>((ours) => this.#ask(ours));
  /** The viewpoint whose truth is known or being traced. */
  #at: Viewpoint | null = null;
  #asked: TimedView | null = null;
  #since = -Infinity;
  #ended = false;

  constructor(viewer: Viewer, surface: KnownSurface, changed: () => void) {
    this.#viewer = viewer;
    this.#changed = changed;
    // The worker's own address is not the page's.
    this.#surface = "faces" in surface ? { faces: new URL(surface.faces, document.baseURI).href } : surface;
    const { positions, cloud } = viewer.scene;
    // A mesh is traced in f32. Coordinates in f64, such as a map's, are taken from the middle of the cloud.
    const single = positions instanceof Float32Array;
    this.#origin = single ? [0, 0, 0] : cloud.center;
    this.#worker = new Reference(
      new Worker(new URL("./truth-worker.ts", import.meta.url), { type: "module" }),
      single ? positions : cloud.local,
    );
    this.#worker.onProgress = (fraction) => {
      this.progress = fraction;
      changed();
    };
  }

  /** Called every frame. */
  follow(): void {
    const { answer, inquiry, cloud } = this.#viewer.scene;
    if (!this.#at || !isSamePlace(answer.question.viewpoint, this.#at, cloud.radius))
      this.#leave(answer.question.viewpoint);
    if (inquiry.busy) this.#since = performance.now();
    const rests = performance.now() - this.#since >= REST;
    // From the same place the truth is known, and only our answer has changed.
    const due = this.result ? answer !== this.#asked : rests && !this.stopped && this.progress === null;
    if (!due || this.problem !== null) return;
    this.#asked = answer;
    if (!this.result) {
      this.progress = 0;
      this.#changed();
    }
    this.#newest.want(answer);
  }

  /** Stops the tracing until the view changes, or until `again`. */
  stop(): void {
    this.stopped = true;
    this.#worker.stop();
    this.#changed();
  }

  again(): void {
    this.stopped = false;
  }

  dispose(): void {
    this.#ended = true;
    this.#worker.dispose();
  }

  /** The view has moved, so the traced truth belongs to another place. */
  #leave(at: Viewpoint): void {
    this.#at = at;
    this.#since = performance.now();
    if (this.progress !== null) this.#worker.stop();
    if (!this.result && !this.stopped) return;
    this.result = null;
    this.stopped = false;
    this.#viewer.showParts(null);
    this.#changed();
  }

  #isOver(): boolean {
    return this.#ended;
  }

  async #ask(ours: TimedView): Promise<void> {
    if (this.#ended) return;
    const { question, visibility } = ours;
    const at = this.#at!;
    try {
      // Exactly that place: a place a few bits off would be traced again.
      const viewpoint = at.map((value, axis) => value - this.#origin[axis]!) as Viewpoint;
      const current = isSamePlace(question.viewpoint, at, this.#viewer.scene.cloud.radius);
      const truth = current
        ? await this.#worker.ask({ surface: this.#surface, viewpoint, visible: visibility.indices })
        : null;
      if (this.#isOver()) return;
      // A truth about a place that has been left is not shown.
      if (truth !== null && !this.stopped && this.#at === at) {
        this.result = { truth, ours };
        this.#viewer.showParts(truth.parts, true);
      }
    } catch (error) {
      if (this.#isOver()) return;
      this.problem = `No rays could be traced: ${sentenceOf(error)}`;
      this.#viewer.showParts(null);
    }
    this.progress = null;
    this.#changed();
  }
}
