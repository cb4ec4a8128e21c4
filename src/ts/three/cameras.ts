import type { Camera, Object3D } from "three";

import { type AnswerKind, type AskedStage, Refinement } from "../follow/refinement.js";
import { type FollowSettings, stagesFor } from "../query/follow-options.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { Eye, requireCamera } from "./eye.js";

/** One camera's view of a cloud, and how far its answers have come. */
export class FollowedCamera {
  readonly camera: Camera;
  readonly eye: Eye;
  readonly refinement: Refinement<VisibilityOptions>;
  /** The question whose answer is drawn for this camera. */
  drawn: AskedStage | undefined;

  constructor(camera: Camera, eye: Eye, refinement: Refinement<VisibilityOptions>) {
    this.camera = camera;
    this.eye = eye;
    this.refinement = refinement;
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
export class FollowedCameras {
  readonly #settings: FollowSettings;
  readonly #wake: () => void;
  readonly #dropped: (camera: FollowedCamera) => void;
  /** In the order of their last use. */
  readonly #cameras = new Map<Camera, FollowedCamera>();
  #points = 0;
  #spacing = 0;

  /** `wake` is called when a question becomes due. `dropped` is called with a camera that is forgotten. */
  constructor(settings: FollowSettings, wake: () => void, dropped: (camera: FollowedCamera) => void) {
    this.#settings = settings;
    this.#wake = wake;
    this.#dropped = dropped;
  }

  /** The camera that looked last. */
  get last(): FollowedCamera | undefined {
    return [...this.#cameras.values()].at(-1);
  }

  /** A camera, which is now the last one. */
  of(camera: Camera): FollowedCamera {
    requireCamera(camera);
    const followed = this.#cameras.get(camera) ?? this.#added(camera);
    if (this.#cameras.size > 1) {
      this.#cameras.delete(camera);
      this.#cameras.set(camera, followed);
    }
    return followed;
  }

  /** Reads the camera's place in the object's space. Returns whether it has moved. */
  look(followed: FollowedCamera, object: Object3D): boolean {
    followed.eye.look(object, followed.camera);
    if (!followed.eye.isNew) {
      return false;
    }
    followed.eye.note();
    this.#begin(followed);
    return true;
  }

  /** All cameras ask again, because the cloud has changed. */
  again(points: number, spacing: number): void {
    this.#points = points;
    this.#spacing = spacing;
    for (const followed of this.#cameras.values()) {
      followed.eye.spacing = spacing;
      this.#begin(followed);
    }
  }

  /**
   * The camera whose question is due. Drafts go first. With `begunOnly`, views that have no answer yet
   * are left out.
   */
  due(begunOnly: boolean): FollowedCamera | undefined {
    let first: FollowedCamera | undefined;
    for (const followed of this.#cameras.values()) {
      const isLeftOut = begunOnly && !followed.refinement.isBegun;
      const stage = followed.eye.isKnown && !isLeftOut ? followed.refinement.due : undefined;
      if (stage?.kind === "draft") {
        return followed;
      }
      if (stage !== undefined) {
        first ??= followed;
      }
    }
    return first;
  }

  /** Whether the last question about each view was answered, or refused. */
  get areSettled(): boolean {
    return [...this.#cameras.values()].every(({ refinement, eye }) => refinement.isSettled || !eye.isKnown);
  }

  stop(): void {
    for (const { refinement } of this.#cameras.values()) refinement.stop();
  }

  #begin({ refinement }: FollowedCamera): void {
    refinement.moved(stagesFor(this.#settings, this.#points));
  }

  #added(camera: Camera): FollowedCamera {
    const eye = new Eye(this.#settings.moveThreshold);
    eye.spacing = this.#spacing;
    const followed = new FollowedCamera(camera, eye, new Refinement<VisibilityOptions>(this.#wake));
    this.#cameras.set(camera, followed);
    if (this.#cameras.size > MOST) {
      const [oldest, given] = this.#cameras.entries().next().value!;
      this.#cameras.delete(oldest);
      given.refinement.stop();
      this.#dropped(given);
    }
    return followed;
  }
}
