import type { Camera } from "three";

import { HprError } from "../base/errors.js";
import { addTag } from "../base/objects.js";
import type { Visibility } from "../cloud/visibility.js";
import { VisibilityMap } from "../cloud/visibility-map.js";
import { Events as Sender, Readiness } from "../follow/events.js";
import { Follower, type Round } from "../follow/follower.js";
import { type AnswerKind, stagesFor } from "../follow/options.js";
import type { Seen } from "../follow/view.js";
import { type Place, readViewpoint, type Viewpoint, widened } from "../query/positions.js";
import { type Cloud, see } from "../worker/followed-cloud.js";
import { type FollowedCamera, FollowedCameras, inSpace, type Space } from "./cameras.js";
import { type AskedOptions, changedSettings, type FilterSettings, readFilterOptions, withOption } from "./options.js";

/** An answer that is drawn. */
export interface FilterChange {
  /** How many points are drawn; for a map, how many were drawn by the last answer. */
  count: number;
  /** The whole answer about the points of the cloud. Null for a map. */
  visibility: Visibility | null;
  /** The time that the answer took. */
  milliseconds: number;
  /** What the answer is: a map comes before the exact answer. */
  answer: AnswerKind;
  /** The camera that it is for. */
  camera: Camera;
  /** x, y, z in the cloud. Null for an orthographic camera. */
  viewpoint: number[] | null;
  /** x, y, z in the cloud. Null for a perspective camera. */
  direction: number[] | null;
  /** The radius of the answer, and its exponent; for a map, those of the last answer. 0 if it has none, as with looks. */
  radius: number;
  exponent: number;
}

interface FilterEvents {
  change: FilterChange;
  error: { error: Error };
}

/** What a filter draws: the points that each camera sees. */
export interface Drawing {
  /** Whether only the visible points are drawn. */
  enabled: boolean;
  /** Whether hidden points are drawn, too, but dimmed. */
  dim: boolean;
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
      this.#refusal = error;
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
  /** @internal */
  protected readonly settings: FilterSettings;
  readonly #object: Space;
  readonly #names: readonly string[];
  /** The errors that listeners have not received yet. They are sent last, because listeners may throw. */
  readonly #untold: { event: Events["error"]; isOfView: boolean }[] = [];
  /** Whether a camera has moved since the cloud was lost. */
  #isMoved = false;
  #isDisposed = false;
  #hasSaid = false;
  #answered = { radius: 0, exponent: 0 };
  /** The cloud whose first map was asked for. */
  #prepared: Cloud | undefined;
  /** The last refusal, if nothing was answered since. */
  #refusal: Error | undefined;
  /** Called when a cloud may have come. */
  #turns: (() => void)[] = [];

  static {
    addTag(this.prototype, "HiddenPointFilter");
  }

  /** `object` has the space of the cloud. `names` are those of options that only this filter has. */
  constructor(object: Space, options: unknown, names: readonly string[] = []) {
    super();
    this.#object = object;
    this.#names = names;
    this.settings = readFilterOptions(options, names);
    this.cameras = new FollowedCameras(
      this.settings,
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

  /** Whether hidden points are not drawn (`"hide"`), or faintly (`"dim"`). */
  get mode(): "hide" | "dim" {
    return this.settings.dim ? "dim" : "hide";
  }

  /** @throws HprError `option` for another value, or if the material cannot be dimmed. */
  set mode(mode: "hide" | "dim") {
    const settings = readFilterOptions({ ...this.settings.given, mode }, this.#names);
    const before = this.settings.dim;
    this.settings.dim = settings.dim;
    try {
      this.drawing.dim = settings.dim;
    } catch (error) {
      this.settings.dim = before;
      throw error;
    }
    this.settings.given = settings.given;
  }

  /** The option `looks`. If it is set, `exponent`, `radius` and `inversion` are automatic. */
  get looks(): 2 | 3 | undefined {
    return this.settings.given.looks;
  }

  /** @throws HprError `option`. */
  set looks(looks: 2 | 3 | undefined) {
    this.setOptions(withOption(this.settings, "looks", looks));
  }

  /** The option `exponent`. If it is set, `looks`, `thickness`, `radius` and `inversion` are no longer. */
  get exponent(): number | undefined {
    return this.settings.given.exponent;
  }

  /** @throws HprError `option`. */
  set exponent(exponent: number | undefined) {
    this.setOptions(withOption(this.settings, "exponent", exponent));
  }

  /** The option `thickness` of the looks. */
  get thickness(): number | "auto" | undefined {
    return this.settings.given.thickness;
  }

  /** @throws HprError `option`. */
  set thickness(thickness: number | "auto" | undefined) {
    this.setOptions(withOption(this.settings, "thickness", thickness));
  }

  /** The option `surface` of the looks. */
  get surface(): "auto" | "clean" | "noisy" | "layered" | undefined {
    return this.settings.given.surface;
  }

  /** @throws HprError `option`. */
  set surface(surface: "auto" | "clean" | "noisy" | "layered" | undefined) {
    this.setOptions(withOption(this.settings, "surface", surface));
  }

  /**
   * Asks with these options of a view and `settle` from now on, in place of those before. At rest, the final answer
   * comes at once.
   *
   * @throws HprError `option`. Then nothing has changed.
   */
  setOptions(options: AskedOptions): void {
    const settings = changedSettings(this.settings, options, this.#names);
    if (textOf(settings.stages) === textOf(this.settings.stages)) return;
    Object.assign(this.settings, settings);
    this.cameras.reconsider();
    // The next frame may take up more.
    queueMicrotask(() => this.follower.follow());
  }

  /** The radius of the last answer, in the points' units. 0 before it, and if it has none, as with looks. */
  get radius(): number {
    return this.#answered.radius;
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
   *
   * @param viewpoint x, y, z in the cloud, if the visible points are those of another place than the camera's.
   */
  update(camera: Camera, viewpoint?: Viewpoint): void {
    if (this.#isDisposed) return;
    let isChanged;
    try {
      this.drawing.follow();
      if (!this.enabled || this.frozen) return;
      const followed = this.cameras.of(camera);
      this.drawing.select(followed);
      if (this.cameras.look(followed, this.#object, viewpoint)) {
        this.#isMoved = true;
        this.leave(followed);
      }
      isChanged = this.noticeChanges();
      if (followed.isOutdated(this.settings.stale)) {
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

  /**
   * Whether the camera of the last `update` sees a place in the world, such as that of a label, with the options of the
   * answer at rest. No point need be there.
   *
   * @throws HprError (as a rejection) `option` before the first `update` and for an orthographic camera, `viewpoint`,
   *   `disposed`, and the error of a refused cloud.
   */
  async sees(place: { readonly x: number; readonly y: number; readonly z: number }): Promise<boolean> {
    const asked = readViewpoint(place, 3, "place") as [number, number, number];
    const seat = this.cameras.last?.place;
    if (seat === undefined || seat.isDirection) {
      throw new HprError("option", "sees() needs an update with a perspective camera");
    }
    const { options } = this.settings.stages.at(-1)!;
    const { origin = [0, 0, 0] } = this.settings;
    const target = inSpace(this.#object, asked).map((value, axis) => value + origin[axis]!);
    for (;;) {
      if (this.#isDisposed) throw disposed();
      const { cloud } = this;
      try {
        if (cloud) return (await cloud.sees(seat.from, target, options))[0] === 1;
      } catch (error) {
        // The points have changed, and another cloud takes its place.
        if (cloud === this.cloud) throw error;
        continue;
      }
      if (!this.follower.isWaiting && !this.isStale) {
        if (this.#refusal !== undefined) throw this.#refusal;
        // Without points, nothing hides the place.
        return true;
      }
      await new Promise<void>((turn) => this.#turns.push(turn));
    }
  }

  /** Draws everything as it was before, and frees the memory of the cloud. May be called twice. */
  dispose(): void {
    if (this.#isDisposed) return;
    this.#isDisposed = true;
    this.follower.stop();
    this.cameras.stop();
    this.drawing.dispose();
    this.dropCloud();
    this.#turn();
    // The caller of dispose() knows this already, so this is never an unhandled rejection.
    this.readiness.reject(disposed(), true);
  }

  /** The cloud that is asked. @internal */
  protected abstract get cloud(): Cloud | undefined;

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
   * Asks the cloud about a camera's view. `draw` draws the answer, and returns what else listeners are told, or undefined
   * if the answer is about other points. `drawMap` does the same with a map.
   *
   * @internal
   */
  protected view<Told extends { count: number }>(
    cloud: Cloud,
    camera: FollowedCamera,
    draw: (answer: Visibility) => Told | undefined,
    drawMap: (map: VisibilityMap) => Told | undefined,
  ): Round<Seen> {
    camera.askedAt = performance.now();
    return camera.see(
      this.settings.stale,
      (place, stage) => see(cloud, place, stage, this.settings.origin),
      (answer, kind, milliseconds, seat) => {
        const isMap = answer instanceof VisibilityMap;
        const drawn = isMap ? drawMap(answer) : draw(answer);
        if (drawn === undefined) return undefined;
        this.follower.answered();
        this.#refusal = undefined;
        if (!isMap) {
          this.#answered = { radius: answer.radius, exponent: answer.exponent };
          this.readiness.resolve();
        }
        const { from, isDirection } = seat;
        const [viewpoint, direction] = isDirection ? [null, [...from]] : [[...from], null];
        const place = { camera: camera.camera, viewpoint, direction };
        const visibility = isMap ? null : answer;
        const change = { ...drawn, ...this.#answered, ...place, visibility, milliseconds, answer: kind };
        if (!isMap && camera.isSettled) this.#prepareMaps(cloud, seat);
        return () => {
          this.tell();
          this.send("change" as never, change as never);
        };
      },
    );
  }

  /** The first map of a cloud takes longer, so it is made before a camera moves. */
  #prepareMaps(cloud: Cloud, { from, isDirection, cone }: Place): void {
    const [map] = stagesFor(this.settings, cloud.length, this.drawing.isAble);
    if (this.#prepared === cloud || isDirection || map?.kind !== "map") return;
    this.#prepared = cloud;
    // If it is refused, the first move says why; if the filter is disposed of, nobody needs it.
    Promise.resolve(cloud.visibilityMap(from, { ...map.options, towards: widened(cone) })).catch(() => undefined);
  }

  /** Says once that no map can be drawn. */
  #sayUnable(): void {
    if (this.settings.mapped !== undefined && this.drawing.isAble === false && !this.#hasSaid) {
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
    this.#turn();
  }

  #turn(): void {
    for (const turn of this.#turns.splice(0)) turn();
  }
}

function disposed(): HprError {
  return new HprError("disposed", "this filter has been disposed of");
}

/** A number for each mask: as text, one of millions of points would take the memory. */
const masks = new WeakMap<object, number>();
let known = 0;

/** Options as text. A mask that is another array is another mask. */
function textOf(options: unknown): string {
  return JSON.stringify(options, (_, value: unknown) => {
    if (!ArrayBuffer.isView(value)) return value;
    if (!masks.has(value)) masks.set(value, known++);
    return masks.get(value);
  });
}
