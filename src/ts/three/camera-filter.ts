import type { Camera } from "three";

import { HprError } from "../base/errors.js";
import { addTag } from "../base/tag.js";
import type { Visibility } from "../cloud/visibility.js";
import { VisibilityMap } from "../cloud/visibility-map.js";
import { Events as Sender } from "../follow/events.js";
import { Follower, type Round } from "../follow/follower.js";
import { Readiness } from "../follow/readiness.js";
import type { AnswerKind, AskedStage } from "../follow/refinement.js";
import type { FollowSettings } from "../query/follow-options.js";
import type { Place } from "../query/place.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { type FollowedCamera, FollowedCameras } from "./cameras.js";
import type { Seen } from "../worker/followed-view.js";
import type { Space } from "./eye.js";

interface FilterEvents {
  change: { count: number; milliseconds: number; answer: AnswerKind; camera: Camera };
  error: { error: Error };
}

/** What listeners are told about an answer. */
export interface Told {
  count: number;
}

/** What a filter draws: the points that each camera sees. */
export interface Drawing {
  /** Whether only the visible points are drawn. */
  enabled: boolean;
  /** Copies the changes of the points since the last frame. */
  follow(): void;
  /** Draws what this camera sees. */
  select(camera: unknown): void;
  /** Draws all points for this camera until its next answer. */
  setStale(camera: unknown): void;
  /** Whether maps can be drawn. Undefined until points were drawn once. */
  readonly isAble: boolean | undefined;
  /** Draws by a map for this camera until its next answer. */
  map(camera: unknown, map: VisibilityMap): void;
  /** Forgets the answers for this camera. */
  drop(camera: unknown): void;
  dispose(): void;
}

/**
 * What the filters have in common: the cameras, the questions about their views, losses, refusals and listeners.
 * An error without a listener becomes an unhandled rejection, like the error of any promise that nobody awaits.
 */
export abstract class CameraFilter<Events extends FilterEvents> extends Sender<Events> {
  /**
   * While true, the filter asks about no new view, even if the camera moves. An answer that is on
   * its way is still drawn, and so are better answers for the same view.
   */
  frozen = false;
  /** @internal */
  protected readonly readiness = new Readiness();
  /**
   * Resolves when the first exact answer is drawn. A `HiddenPointFilter` that was not updated so far resolves it
   * when its points are prepared. Rejects with the error if the points or that view are refused.
   */
  readonly ready: Promise<void> = this.readiness.promise;

  /** @internal */
  protected readonly cameras: FollowedCameras;
  /** @internal */
  protected readonly follower = new Follower({
    next: () => this.next(),
    refused: (error, again) => {
      if (!again) this.report({ error });
      this.tell();
    },
    lost: (isComingBack) => {
      this.dropCloud();
      // If the cloud does not come back by itself, another view may succeed.
      this.#isMoved &&= isComingBack;
      this.tell();
    },
  });
  /** @internal */
  protected abstract readonly drawing: Drawing;
  readonly #object: Space;
  readonly #settings: FollowSettings;
  /** The errors that listeners have not received yet. They are sent last, because listeners may throw. */
  readonly #untold: { event: Events["error"]; isOfView: boolean }[] = [];
  /** Whether a camera has moved since the cloud was lost. */
  #isMoved = false;
  #isDisposed = false;
  #hasSaid = false;

  static {
    addTag(this.prototype, "HiddenPointFilter");
  }

  /** `object` has the space of the cloud. */
  constructor(object: Space, settings: FollowSettings) {
    super();
    this.#object = object;
    this.#settings = settings;
    this.cameras = new FollowedCameras(
      settings,
      () => this.follower.follow(),
      (camera) => {
        this.drawing.drop(camera);
        this.leave(camera);
      },
      () => this.drawing.isAble === true,
    );
  }

  /** While false, everything is drawn and nothing is asked. Default true. */
  get enabled(): boolean {
    return this.drawing.enabled;
  }

  set enabled(enabled: boolean) {
    this.drawing.enabled = enabled;
  }

  /** What is drawn for the camera of the last `update`. Null before the first answer. */
  get answer(): AnswerKind | null {
    return this.cameras.last?.answer ?? null;
  }

  /**
   * Whether no answer is on its way or due. Then the picture shows the final answer for the points and the
   * camera of the last `update`, unless these were refused.
   */
  get settled(): boolean {
    if (this.follower.isWaiting || this.follower.isLost) return !this.follower.isWaiting;
    const isIdle = this.frozen || !this.enabled || this.#isDisposed || this.isEmpty;
    return !this.wantsAnswer && (isIdle || this.cameras.areSettled);
  }

  /**
   * Call this in each frame, before rendering (and after a viewer has chosen its nodes). It asks for an answer
   * if the view or the points are new, and draws the answer when it arrives (with `worker: false`, at once).
   * While one view is being answered, only the newest of the later views is kept.
   */
  update(camera: Camera): void {
    if (this.#isDisposed) return;
    let isChanged;
    try {
      this.drawing.follow();
      if (!this.enabled || this.frozen) return;
      const followed = this.cameras.of(camera);
      this.drawing.select(followed);
      if (this.cameras.look(followed, this.#object)) {
        this.#isMoved = true;
        this.leave(followed);
      }
      isChanged = this.noticeChanges();
      if (followed.isOutdated(this.#settings.stale)) {
        this.drawing.setStale(followed);
        followed.drawn = undefined;
      }
      this.#sayUnable();
    } catch (error) {
      this.follower.refuse(error);
      return;
    }
    this.follower.wish(this.#isMoved || isChanged);
    this.tell();
  }

  /** Draws everything as it was before, and frees the memory of the cloud. May be called twice. */
  dispose(): void {
    if (this.#isDisposed) return;
    this.#isDisposed = true;
    this.follower.stop();
    this.cameras.stop();
    this.drawing.dispose();
    this.dropCloud();
    // The caller of dispose() knows this already, so this is never an unhandled rejection.
    this.readiness.reject(new HprError("disposed", "this filter has been disposed of"), true);
  }

  /** Whether the points are not those of the cloud. @internal */
  protected abstract get isStale(): boolean;

  /** Whether there are no points to ask about. @internal */
  protected abstract get isEmpty(): boolean;

  /** The round that is due now. @internal */
  protected abstract next(): Round | undefined;

  /** Notes how the points have changed since the last frame. Returns whether they have. @internal */
  protected abstract noticeChanges(): boolean;

  /** A camera has moved on, or is forgotten. @internal */
  protected abstract leave(camera: FollowedCamera): void;

  /** @internal */
  protected abstract dropCloud(): void;

  /** @internal */
  protected get wantsAnswer(): boolean {
    if (!this.enabled || this.#isDisposed) return false;
    return this.isStale || (!this.isEmpty && this.cameras.due(this.frozen) !== undefined);
  }

  /**
   * Asks the cloud about a camera's view. `draw` draws the answer, and returns what listeners are told, or undefined
   * if the answer is about other points. `drawMap` does the same with a map.
   *
   * @internal
   */
  protected view(
    camera: FollowedCamera,
    ask: (place: Place, stage: AskedStage<VisibilityOptions>) => Seen | Promise<Seen>,
    draw: (answer: Visibility, place: Place) => Told | undefined,
    drawMap: (map: VisibilityMap, place: Place) => Told | undefined,
  ): Round<Seen> {
    return camera.round(this.#settings.stale, ask, (answer, kind, milliseconds, place) => {
      const drawn = answer instanceof VisibilityMap ? drawMap(answer, place) : draw(answer, place);
      if (drawn === undefined) return undefined;
      this.follower.answered();
      if (kind !== "map") this.readiness.resolve();
      const change = { ...drawn, milliseconds, answer: kind, camera: camera.camera };
      return () => {
        this.tell();
        this.send("change" as never, change as never);
      };
    });
  }

  /** Says once that no map can be drawn. */
  #sayUnable(): void {
    if (this.#settings.mapped !== undefined && this.drawing.isAble === false && !this.#hasSaid) {
      this.#hasSaid = true;
      console.info(
        "hidden-point-removal: this renderer or material takes no map of directions, so the last answer stays while the camera moves",
      );
    }
  }

  /** Notes an error, which the next `tell` reports. `isOfView`: without a listener, it rejects `ready`. @internal */
  protected report(event: Events["error"], isOfView = true): void {
    this.#untold.push({ event, isOfView });
  }

  /** @internal */
  protected tell(): void {
    for (const { event, isOfView } of this.#untold.splice(0)) {
      const isHeard = this.hears("error" as never);
      if (isOfView) {
        this.readiness.reject(event.error, isHeard);
      } else if (!isHeard) {
        void Promise.reject(event.error);
      }
      this.send("error" as never, event as never);
    }
  }
}
