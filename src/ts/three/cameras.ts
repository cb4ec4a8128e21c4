import type { Camera } from "three";

import type { Stage } from "../follow/refinement.js";
import { type FollowSettings, REST, stagesFor } from "../query/follow-options.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { FollowedView } from "../worker/followed-view.js";
import { placeOf, requireCamera, type Space } from "./eye.js";

/** One camera's view of a cloud, and how far its answers have come. */
export class FollowedCamera extends FollowedView {
  readonly camera: Camera;

  constructor(camera: Camera, wake: () => void) {
    super(wake);
    this.camera = camera;
  }

  /** Whether the view has moved a moment ago. */
  get isMoving(): boolean {
    return this.refinement.stillFor < REST;
  }
}

/** The number of cameras that are remembered. If there are more, the one that was not used for the longest time goes. */
const MOST = 8;

/** The cameras that look at one cloud, each with its own view and answers. */
export class FollowedCameras {
  readonly #settings: FollowSettings;
  readonly #wake: () => void;
  readonly #dropped: (camera: FollowedCamera) => void;
  readonly #drawsMaps: () => boolean;
  /** In the order of their last use. */
  readonly #cameras = new Map<Camera, FollowedCamera>();
  #points = 0;
  #spacing = 0;

  /**
   * `wake` is called when a question becomes due. `dropped` is called with a camera that is forgotten. `drawsMaps`
   * tells whether maps can be drawn.
   */
  constructor(
    settings: FollowSettings,
    wake: () => void,
    dropped: (camera: FollowedCamera) => void,
    drawsMaps: () => boolean,
  ) {
    this.#settings = settings;
    this.#wake = wake;
    this.#dropped = dropped;
    this.#drawsMaps = drawsMaps;
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
  look(followed: FollowedCamera, object: Space): boolean {
    const { place, rounding } = placeOf(followed.camera, object);
    if (!followed.move(place, this.#spacing, rounding)) return false;
    followed.refinement.moved(this.#stagesFor(followed));
    return true;
  }

  /** All cameras ask again, because the cloud has changed. */
  again(points: number, spacing: number): void {
    this.#points = points;
    this.#spacing = spacing;
    for (const followed of this.#cameras.values()) {
      const { refinement, isMoving } = followed;
      const stages = this.#stagesFor(followed);
      // At rest, the exact answer comes at once: a map would only delay it.
      refinement.begin(stages, stages[0]?.kind === "map" && !isMoving ? 1 : 0);
    }
  }

  /**
   * The camera whose question is due. Maps go first. With `begunOnly`, views that have no answer yet
   * are left out.
   */
  due(begunOnly: boolean): FollowedCamera | undefined {
    let first: FollowedCamera | undefined;
    for (const followed of this.#cameras.values()) {
      const isLeftOut = begunOnly && !followed.refinement.isBegun;
      const stage = followed.place !== undefined && !isLeftOut ? followed.refinement.due : undefined;
      if (stage?.kind === "map") return followed;
      if (stage !== undefined) first ??= followed;
    }
    return first;
  }

  /** Whether the last question about each view was answered, or refused. */
  get areSettled(): boolean {
    return [...this.#cameras.values()].every(({ refinement, place }) => refinement.isSettled || place === undefined);
  }

  stop(): void {
    for (const { refinement } of this.#cameras.values()) refinement.stop();
  }

  #stagesFor({ place }: FollowedCamera): readonly Stage<VisibilityOptions>[] {
    return stagesFor(this.#settings, this.#points, this.#drawsMaps() && place?.isDirection !== true);
  }

  #added(camera: Camera): FollowedCamera {
    const followed = new FollowedCamera(camera, this.#wake);
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
