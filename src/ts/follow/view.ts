import { HprError } from "../base/errors.js";
import type { Visibility } from "../cloud/visibility.js";
import { VisibilityMap } from "../cloud/visibility-map.js";
import { isFarFrom, isNear, isTurned, type Place } from "../query/positions.js";
import type { VisibilityOptions } from "../query/view-options.js";
import type { Round } from "./follower.js";
import type { AnswerKind, FollowSettings, Stage } from "./options.js";

/** A question that was asked. */
export interface AskedStage<Options = unknown> extends Stage<Options> {
  /** Aborts when the view moves and a newer answer is better than the answer to this question. */
  readonly signal: AbortSignal;
  /** Whether the view has not moved since the question. */
  readonly isCurrent: () => boolean;
  /** How many points a map should look through, so that each frame gets one. */
  readonly points: number;
}

/**
 * A view that moves, and how far its answers have come. With each move, the questions begin again
 * with the first one. The first one is always finished, so that a view in motion gets answers. A
 * later question is given up when the view moves on.
 *
 *     map, or operator ──► (rest) ──► looks
 *       ▲ each move begins here
 */
export class Refinement<Options = unknown> {
  readonly #wake: () => void;
  readonly #pace = new Pace();
  #stages: readonly Stage<Options>[] = [];
  #next = 0;
  #isSettled = true;
  #begins = 0;
  #movedAt = -Infinity;
  /** When the last frame was, and the milliseconds between the last two of them. */
  #framedAt = -Infinity;
  #frame = 0;
  #overtaking: AbortController | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `wake` is called when the view has come to rest and a question waits for this. */
  constructor(wake: () => void) {
    this.#wake = wake;
  }

  /** The question that is due now. */
  get due(): Stage<Options> | undefined {
    const stage = this.#stages[this.#next];
    if (stage === undefined || stage.rest === 0) {
      return stage;
    }
    // A frame of a large cloud may take longer than a rest.
    const remaining = Math.max(stage.rest, STILL * this.#frame) - this.stillFor;
    if (remaining <= 0) {
      return stage;
    }
    this.#timer ??= setTimeout(() => {
      this.#timer = undefined;
      this.#wake();
    }, remaining);
    return undefined;
  }

  /** For how many milliseconds the view has not moved. */
  get stillFor(): number {
    return performance.now() - this.#movedAt;
  }

  /** Whether the first question was asked. */
  get isBegun(): boolean {
    return this.#next > 0;
  }

  /** Whether the last question was answered, or refused. */
  get isSettled(): boolean {
    return this.#isSettled;
  }

  /** To be called in each frame. Where nothing is drawn at rest, the time between frames is no frame's. */
  protected framed(): void {
    const now = performance.now();
    const passed = now - this.#framedAt;
    if (passed < 1) return;
    this.#frame = passed < LONGEST_FRAME ? passed : 0;
    this.#framedAt = now;
  }

  /** To be called with the first view and with each move. */
  moved(stages: readonly Stage<Options>[]): void {
    this.#movedAt = performance.now();
    this.begin(stages);
  }

  /** Other questions are asked about the same view, beginning with this one. */
  begin(stages: readonly Stage<Options>[], first = 0): void {
    this.#begins += 1;
    this.#stages = stages;
    this.#next = first;
    this.#isSettled = first >= stages.length;
    this.#overtaking?.abort();
    this.stop();
  }

  /** The round that asks the question that is due. */
  round<Answer>(
    ask: (stage: AskedStage<Options>) => Answer | Promise<Answer>,
    use: (answer: Answer, stage: AskedStage<Options>) => (() => void) | undefined,
  ): Round<Answer> {
    const stage = this.#take();
    const isLast = this.#next === this.#stages.length;
    const begun = performance.now();
    return {
      ask: () => {
        try {
          return ask(stage);
        } catch (error) {
          this.#end(stage);
          throw error;
        }
      },
      use: (answer) => {
        if (isLast) this.#end(stage);
        if (stage.kind === "map") this.#pace.took(performance.now() - begun);
        return use(answer, stage);
      },
      isGivenUp: (error) => {
        // If a map is refused, the exact question says why, or is answered.
        if (isAbort(error) || (stage.kind === "map" && isRefusal(error))) {
          return true;
        }
        this.#end(stage);
        return false;
      },
    };
  }

  /** Nothing wakes any more, until the next move. */
  stop(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }

  #take(): AskedStage<Options> {
    const stage = this.#stages[this.#next]!;
    const isLater = this.#next > 0;
    this.#next += 1;
    const overtaking = new AbortController();
    this.#overtaking = isLater ? overtaking : undefined;
    const begins = this.#begins;
    const isCurrent = () => begins === this.#begins;
    return { ...stage, signal: overtaking.signal, isCurrent, points: this.#pace.points };
  }

  /** Nothing more is asked about this view. If a question was refused, the later ones would be refused, too. */
  #end(stage: AskedStage<Options>): void {
    if (stage.isCurrent()) {
      this.#next = this.#stages.length;
      this.#isSettled = true;
    }
  }
}

/** For how many frames nothing moves at rest, and the milliseconds of the longest frame. */
const STILL = 2;
const LONGEST_FRAME = 500;

/** What a view shows. */
export type Seen = Visibility | VisibilityMap;

/** A view of a cloud that moves, and what is drawn of it. */
export class FollowedView extends Refinement<VisibilityOptions> {
  /** The question whose answer is drawn. Undefined: all points are drawn. */
  drawn: AskedStage | undefined;
  /** The place that questions are about. Undefined before the first one. */
  place: Place | undefined;
  #before: Place | undefined;
  #drawnFrom: Place | undefined;
  #map: VisibilityMap | undefined;

  /** What is drawn. Null: all points. */
  get answer(): AnswerKind | null {
    return this.drawn?.kind ?? null;
  }

  /**
   * Takes up the place of a frame. Returns whether it is new, also for a map's directions. `rounding`: how far rounding
   * alone may move it.
   */
  move(place: Place, spacing: number, rounding = 0): boolean {
    this.framed();
    this.#before = this.place;
    const isBeside = this.answer === "map" && isTurned(this.place?.cone, place.cone);
    const isNew = this.place === undefined || isBeside || !isNear(this.place, place, spacing, rounding);
    if (isNew) this.place = place;
    return isNew;
  }

  /** Whether the answer that is drawn must give way to all points. */
  isOutdated(stale: FollowSettings["stale"]): boolean {
    if (this.drawn === undefined || this.drawn.isCurrent()) {
      return false;
    }
    const [map, from, before] = [this.#map, this.#drawnFrom, this.#before];
    const isFar =
      map !== undefined && from !== undefined && before !== undefined && isFarFrom(from, before, map.center);
    return isFar || stale === "all";
  }

  /**
   * The round that asks the question that is due. `draw` draws the answer, and returns the function that
   * informs the listeners, or undefined if the answer is about other points.
   */
  see(
    stale: FollowSettings["stale"],
    ask: (place: Place, stage: AskedStage<VisibilityOptions>) => Seen | Promise<Seen>,
    draw: (answer: Seen, kind: AnswerKind, milliseconds: number, place: Place) => (() => void) | undefined,
  ): Round<Seen> {
    const [begun, place] = [performance.now(), this.place!];
    return this.round(
      (stage) => ask(place, stage),
      (answer, stage) => {
        if (stale === "all" && !stage.isCurrent()) {
          return undefined;
        }
        const tell = draw(answer, stage.kind, performance.now() - begun, place);
        if (tell !== undefined) {
          this.drawn = stage;
          this.#drawnFrom = place;
          if (answer instanceof VisibilityMap) this.#map = answer;
        }
        return tell;
      },
    );
  }
}

/** A map that takes longer, in milliseconds, is older than a frame when it is drawn. */
const FRAME = 16;
/** As many points as a map looks through by default. */
const MOST = 750_000;
const LEAST = 50_000;

/** How many points the next map looks through: so many that it takes a frame, also on a slower machine. */
class Pace {
  #points = MOST;
  #before = FRAME;

  get points(): number {
    return this.#points;
  }

  /** A map took so many milliseconds. Two maps decide: a single one may have waited, or be the first of its size. */
  took(milliseconds: number): void {
    const [faster, slower] = [Math.min(milliseconds, this.#before), Math.max(milliseconds, this.#before)];
    const times = faster > FRAME ? 0.8 : slower < 0.75 * FRAME ? 1.25 : 1;
    const points = Math.min(Math.max(Math.round(this.#points * times), LEAST), MOST);
    this.#before = points === this.#points ? milliseconds : FRAME;
    this.#points = points;
  }
}

function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

/** Whether an error is about the question, and not about the loss of the cloud. */
function isRefusal(error: unknown): boolean {
  return error instanceof HprError && error.code !== "internal" && error.code !== "disposed";
}
