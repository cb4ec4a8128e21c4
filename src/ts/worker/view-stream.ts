import { addTag } from "../base/objects.js";
import { HprError } from "../base/errors.js";
import type { Visibility } from "../cloud/visibility.js";
import { Follower, type Round } from "../follow/follower.js";
import {
  type AnswerKind,
  FOLLOW_OPTIONS,
  type FollowedOptions,
  type FollowOptions,
  followSettings,
  stagesFor,
} from "../follow/options.js";
import { type AskedStage, FollowedView } from "../follow/view.js";
import { type CloudSize, givenOptions, listener } from "../query/options.js";
import { type Place, readViewpoint, type Viewpoint } from "../query/positions.js";
import { VIEW_OPTIONS, type VisibilityOptions } from "../query/view-options.js";

/** The options of a {@link ViewStream}: those of each view, and how answers follow the viewpoint. */
export type ViewStreamOptions = FollowedOptions &
  FollowOptions & {
    /** Is called with each answer. */
    onAnswer?: ((answer: StreamedAnswer) => void) | undefined;
    /**
     * Is called when a view is refused. After that, it is called again only if there was an answer in
     * between. Without it, the error rejects the iterators that wait. If none waits, the error is an
     * unhandled rejection.
     */
    onError?: ((error: Error) => void) | undefined;
  };

/** An answer, and the view that it belongs to. */
export interface StreamedAnswer {
  /** What the answer is. */
  readonly answer: AnswerKind;
  readonly visibility: Visibility;
  /** x, y, z; null for a view along a direction. */
  readonly viewpoint: readonly number[] | null;
  /** x, y, z; null for a view from a viewpoint. */
  readonly direction: readonly number[] | null;
  /** The time from the question to the answer. */
  readonly milliseconds: number;
}

/** What a stream needs of its cloud. */
export interface StreamedCloud {
  readonly dimension: number;
  /** Another object after each change of the cloud. */
  size: () => CloudSize;
  ask(place: Place, options: VisibilityOptions & { signal: AbortSignal }): Promise<Visibility>;
}

/**
 * The answers for one viewpoint that moves: the newest exact answers, and at rest the answer with the
 * options `settle`, which is given up when the viewpoint moves on. A cloud may have several streams, for
 * instance one for each camera of a page.
 *
 * ```js
 * const stream = cloud.follow({ settle: { looks: 3 } });
 * renderer.setAnimationLoop(() => {
 *   stream.look(camera.position.toArray()); // in each frame; asks only after a move
 *   renderer.render(scene, camera);
 * });
 * for await (const { answer, visibility } of stream) {
 *   draw(visibility.indices); // answer is "operator", then "looks"
 * }
 * ```
 *
 * An iterator that is slower than the answers gets the newest one. Instead of an iterator, `onAnswer`
 * gets every answer.
 */
export class ViewStream implements AsyncIterable<StreamedAnswer> {
  readonly #cloud: StreamedCloud;
  readonly #options: ViewStreamOptions;
  readonly #settings: ReturnType<typeof followSettings>;
  readonly #follower: Follower;
  readonly #view = new FollowedView(() => this.#follower.follow());
  /** The size of the cloud that was asked about. */
  #size: CloudSize | undefined;
  #last: { answer: StreamedAnswer; stage: AskedStage } | undefined;
  #waiting: { resolve: () => void; reject: (error: Error) => void }[] = [];
  #isOver = false;

  static {
    addTag(this.prototype, "ViewStream");
  }

  /** @internal */
  constructor(cloud: StreamedCloud, options: unknown) {
    const given = givenOptions(options, VIEW_OPTIONS, FOLLOW_OPTIONS, ["onAnswer", "onError"]);
    for (const name of ["onAnswer", "onError"]) listener(given, name);
    this.#cloud = cloud;
    this.#options = given;
    this.#settings = followSettings(given, { dimension: cloud.dimension });
    this.#follower = new Follower({
      next: () => this.#round(),
      refused: (error, again) => {
        this.#refused(error, again);
      },
    });
  }

  /**
   * The view is now from this viewpoint. Call this in each frame. Nothing is asked while the viewpoint
   * and the cloud stay the same.
   *
   * @param viewpoint x, y, z in the cloud's units.
   * @throws HprError `viewpoint` for a value that is not an array of as many numbers as the cloud has dimensions.
   */
  look(viewpoint: Viewpoint): void {
    this.#want({ from: readViewpoint(viewpoint, this.#cloud.dimension), isDirection: false });
  }

  /**
   * The view is now along this direction, as an orthographic camera looks.
   *
   * @throws HprError `viewpoint` for a value that is not an array of three numbers.
   */
  lookAlong(direction: Viewpoint): void {
    this.#want({ from: readViewpoint(direction, 3, "direction"), isDirection: true });
  }

  /** The last answer, or null before the first one. */
  get last(): StreamedAnswer | null {
    return this.#last?.answer ?? null;
  }

  /** Whether the last answer is final: no better one comes until the view or the cloud changes. */
  get settled(): boolean {
    return this.#view.isSettled && !this.#follower.isBusy;
  }

  /**
   * The indices of the points to draw now, ascending. This is the memory of the last answer. Null means
   * all points: before the first answer, and with `stale: "all"` until the present view is answered.
   */
  get visible(): Uint32Array | null {
    const isStale = this.#settings.stale === "all" && this.#last?.stage.isCurrent() !== true;
    return isStale ? null : (this.#last?.answer.visibility.indices ?? null);
  }

  /** The answers from now on. Ends when the stream is disposed of. */
  async *[Symbol.asyncIterator](): AsyncGenerator<StreamedAnswer, void, undefined> {
    let seen = this.#last;
    while (!this.#isOver) {
      if (this.#last === seen) {
        await new Promise<void>((resolve, reject) => {
          this.#waiting.push({ resolve, reject });
        });
      } else {
        seen = this.#last;
        yield seen!.answer;
      }
    }
  }

  /** Ends the stream. The cloud stays. May be called twice. */
  dispose(): void {
    this.#isOver = true;
    this.#view.begin([]);
    this.#follower.stop();
    this.#wake(({ resolve }) => {
      resolve();
    });
  }

  #want(place: Place): void {
    const size = this.#cloud.size();
    const isMoved = this.#view.move(place, size.spacing);
    if ((isMoved || size !== this.#size) && !this.#isOver) {
      this.#size = size;
      this.#view.moved(stagesFor(this.#settings, size.length));
    }
    this.#follower.follow();
  }

  #round(): Round | undefined {
    const { place, due } = this.#view;
    if (place === undefined || due === undefined) {
      return undefined;
    }
    const begun = performance.now();
    return this.#view.round(
      ({ options, signal }) => this.#cloud.ask(place, { ...options, signal }),
      (visibility, stage) => this.#use(visibility, stage, place, performance.now() - begun),
    );
  }

  #use(visibility: Visibility, stage: AskedStage, { from, isDirection }: Place, milliseconds: number): () => void {
    const answer: StreamedAnswer = {
      answer: stage.kind,
      visibility,
      viewpoint: isDirection ? null : from,
      direction: isDirection ? from : null,
      milliseconds,
    };
    this.#last = { answer, stage };
    this.#follower.answered();
    return () => {
      this.#wake(({ resolve }) => {
        resolve();
      });
      this.#options.onAnswer?.(answer);
    };
  }

  #refused(error: Error, again: boolean): void {
    if (error instanceof HprError && error.code === "disposed") {
      this.dispose();
      return;
    }
    if (again) {
      return;
    }
    const isAwaited = this.#waiting.length > 0;
    this.#wake(({ reject }) => {
      reject(error);
    });
    if (this.#options.onError !== undefined) {
      this.#options.onError(error);
    } else if (!isAwaited) {
      void Promise.reject(error);
    }
  }

  #wake(act: (waiting: { resolve: () => void; reject: (error: Error) => void }) => void): void {
    for (const waiting of this.#waiting.splice(0)) act(waiting);
  }
}
