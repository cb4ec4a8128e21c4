import { HprError } from "../base/errors.js";
import type { Round } from "./follower.js";
import { Pace } from "./pace.js";

/**
 * What an answer is. `"operator"` is the exact answer of one flip. `"looks"` is an answer of two or three
 * looks. `"map"` is a map of directions, by which the graphics card leaves out hidden points.
 */
export type AnswerKind = "map" | "operator" | "looks";

/** One of the questions that are asked about a view, one after another. */
export interface Stage<Options = unknown> {
  readonly kind: AnswerKind;
  readonly options: Options;
  /** The milliseconds without a move after which this is asked. */
  readonly rest: number;
}

/** A question that was asked. */
export interface AskedStage<Options = unknown> extends Stage<Options> {
  /** Aborts when the view moves and a newer answer is better than the answer to this question. */
  readonly signal: AbortSignal;
  /** Whether the view has not moved since the question. */
  readonly isCurrent: () => boolean;
  /** How many points a map should have, so that each frame gets one. */
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
  #overtaking: AbortController | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `wake` is called when the view has come to rest and a question waits for this. */
  constructor(wake: () => void) {
    this.#wake = wake;
  }

  /** The question that is due now. */
  get due(): Stage<Options> | undefined {
    const stage = this.#stages[this.#next];
    const remaining = (stage?.rest ?? 0) - this.stillFor;
    if (stage === undefined || stage.rest === 0 || remaining <= 0) {
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

function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

/** Whether an error is about the question, and not about the loss of the cloud. */
function isRefusal(error: unknown): boolean {
  return error instanceof HprError && error.code !== "internal" && error.code !== "disposed";
}
