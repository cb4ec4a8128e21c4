import type { TimedView } from "../ask/inquiry.ts";
import { isSamePlace } from "../ask/question.ts";
import { Follower, type Round } from "hidden-point-removal/worker";
import { Newest } from "../ask/newest.ts";
import { Rest } from "../ask/rest.ts";
import type { KnownSurface } from "../samples/samples.ts";
import type { Viewpoint } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import type { TruthAnswer } from "./protocol.ts";
import { sentenceOf } from "./reference.ts";
import { Truth } from "./truth.ts";

/** Rays are traced when the view has been at rest for this number of milliseconds. */
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
  readonly #truth: Truth;
  readonly #worker: Truth["worker"];
  readonly #newest = new Newest<TimedView>((a, b) => a === b);
  readonly #follower = new Follower({
    next: () => (this.#newest.isNew ? this.#round(this.#newest.take()) : undefined),
    refused: (error) => {
      this.problem = `No rays could be traced: ${sentenceOf(error)}`;
      this.#viewer.showParts(null);
      this.progress = null;
      this.#changed();
    },
  });
  /** The viewpoint whose truth is known or is being traced. */
  #at: Viewpoint | null = null;
  readonly #rest = new Rest(REST);

  constructor(viewer: Viewer, surface: KnownSurface, changed: () => void) {
    this.#viewer = viewer;
    this.#changed = changed;
    this.#truth = new Truth(viewer.scene, surface);
    this.#worker = this.#truth.worker;
    this.#worker.onProgress = (fraction) => {
      this.progress = fraction;
      changed();
    };
  }

  /** Called every frame. */
  follow(): void {
    const { answer, inquiry, cloud } = this.#viewer.scene;
    if (!this.#at || !isSamePlace(answer.question.viewpoint, this.#at, cloud.radius)) {
      this.#leave(answer.question.viewpoint);
    }
    if (inquiry.busy) this.#rest.moved();
    // With a result, the truth about this place is known, and only our answer can have changed.
    const due = this.result
      ? answer !== this.#newest.wanted
      : this.#rest.isReached && !this.stopped && this.progress === null;
    if (!due || this.problem !== null) return;
    if (!this.result) {
      // Rays for the same answer may have been given up before. They must be traced again.
      this.#newest.forget();
      this.progress = 0;
      this.#changed();
    }
    this.#newest.want(answer);
    this.#follower.follow();
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
    this.#follower.stop();
    this.#worker.dispose();
  }

  /** The view has moved, so the traced truth belongs to another place. */
  #leave(at: Viewpoint): void {
    this.#at = at;
    this.#rest.moved();
    if (this.progress !== null) this.#worker.stop();
    if (!this.result && !this.stopped) return;
    this.result = null;
    this.stopped = false;
    this.#viewer.showParts(null);
    this.#changed();
  }

  #round(ours: TimedView): Round<TruthAnswer | null> {
    const { question, visibility } = ours;
    const at = this.#at!;
    return {
      ask: () => {
        // The place is exact: a place that differs in the last bits would be traced again.
        const current = isSamePlace(question.viewpoint, at, this.#viewer.scene.cloud.radius);
        if (!current) return null;
        const hull = ours.kind === "looks" ? this.#viewer.scene.inquiry.hullFor(ours) : null;
        return this.#truth.ask(at, visibility.indices, hull && hull.visibility.indices);
      },
      use: (truth) => {
        // The truth is not shown if the viewpoint has left the place.
        if (truth !== null && !this.stopped && this.#at === at) {
          this.result = { truth, ours };
          this.#viewer.showParts(truth.parts, true);
        }
        this.progress = null;
        return this.#changed;
      },
    };
  }
}
