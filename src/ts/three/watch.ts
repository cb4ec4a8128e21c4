import type { Camera, Object3D } from "three";

import { type AnswerKind, Gaze, type Turn } from "../follow/gaze.js";
import { type FollowSettings, stagesFor } from "../query/follow-options.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { Eye, requireCamera } from "./eye.js";

/** One camera's view of a cloud, and how far its answers have come. */
export class Watch {
  readonly camera: Camera;
  readonly eye: Eye;
  readonly gaze: Gaze<VisibilityOptions>;
  /** The question whose answer is drawn for this camera. */
  drawn: Turn | undefined;

  constructor(camera: Camera, eye: Eye, gaze: Gaze<VisibilityOptions>) {
    this.camera = camera;
    this.eye = eye;
    this.gaze = gaze;
  }

  /** What is drawn for this camera. Null: all points. */
  get answer(): AnswerKind | null {
    return this.drawn?.kind ?? null;
  }

  /** Whether the answer that is drawn belongs to the camera's present view. */
  get isCurrent(): boolean {
    return this.drawn?.isCurrent() ?? false;
  }
}

/** The number of cameras that are remembered. If there are more, the one that was not used for the longest time goes. */
const MOST = 8;

/** The cameras that look at one cloud, each with its own view and answers. */
export class Watches {
  readonly #settings: FollowSettings;
  readonly #wake: () => void;
  readonly #dropped: (watch: Watch) => void;
  /** In the order of their last use. */
  readonly #watches = new Map<Camera, Watch>();
  #points = 0;
  #spacing = 0;

  /** `wake` is called when a question becomes due. `dropped` is called with a camera that is forgotten. */
  constructor(settings: FollowSettings, wake: () => void, dropped: (watch: Watch) => void) {
    this.#settings = settings;
    this.#wake = wake;
    this.#dropped = dropped;
  }

  /** The camera that looked last. */
  get last(): Watch | undefined {
    return [...this.#watches.values()].at(-1);
  }

  /** The watch of a camera, which is now the last one. */
  of(camera: Camera): Watch {
    requireCamera(camera);
    const watch = this.#watches.get(camera) ?? this.#added(camera);
    if (this.#watches.size > 1) {
      this.#watches.delete(camera);
      this.#watches.set(camera, watch);
    }
    return watch;
  }

  /** Reads the camera's place in the object's space. Returns whether it has moved. */
  look(watch: Watch, object: Object3D): boolean {
    watch.eye.look(object, watch.camera);
    if (!watch.eye.isNew) {
      return false;
    }
    watch.eye.note();
    this.#begin(watch);
    return true;
  }

  /** All cameras ask again, because the cloud has changed. */
  again(points: number, spacing: number): void {
    this.#points = points;
    this.#spacing = spacing;
    for (const watch of this.#watches.values()) {
      watch.eye.spacing = spacing;
      this.#begin(watch);
    }
  }

  /**
   * The camera whose question is due. Drafts go first. With `begunOnly`, views that have no answer yet
   * are left out.
   */
  due(begunOnly: boolean): Watch | undefined {
    let first: Watch | undefined;
    for (const watch of this.#watches.values()) {
      const isLeftOut = begunOnly && !watch.gaze.isBegun;
      const stage = watch.eye.isKnown && !isLeftOut ? watch.gaze.due : undefined;
      if (stage?.kind === "draft") {
        return watch;
      }
      if (stage !== undefined) {
        first ??= watch;
      }
    }
    return first;
  }

  /** Whether no question is left to ask. */
  get isComplete(): boolean {
    return [...this.#watches.values()].every(({ gaze, eye }) => gaze.isComplete || !eye.isKnown);
  }

  stop(): void {
    for (const { gaze } of this.#watches.values()) gaze.stop();
  }

  #begin({ gaze }: Watch): void {
    gaze.stages = stagesFor(this.#settings, this.#points);
    gaze.moved();
  }

  #added(camera: Camera): Watch {
    const eye = new Eye(this.#settings.moveThreshold);
    eye.spacing = this.#spacing;
    const watch = new Watch(camera, eye, new Gaze<VisibilityOptions>([], this.#wake));
    this.#watches.set(camera, watch);
    if (this.#watches.size > MOST) {
      const [oldest, given] = this.#watches.entries().next().value!;
      this.#watches.delete(oldest);
      given.gaze.stop();
      this.#dropped(given);
    }
    return watch;
  }
}
