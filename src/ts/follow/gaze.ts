import { Rest } from "./rest.js";

/**
 * What an answer is. `"draft"` holds all visible points and some hidden ones. `"operator"` is the exact
 * answer of one flip. `"looks"` is an answer of two or three looks.
 */
export type AnswerKind = "draft" | "operator" | "looks";

/** One of the questions that are asked about a view, one after another. */
export interface Stage<Options = unknown> {
  readonly kind: AnswerKind;
  readonly options: Options;
  /** Whether this is asked only when the view has come to rest. */
  readonly atRest: boolean;
}

/** A question that was taken from a gaze. */
export interface Turn<Options = unknown> extends Stage<Options> {
  /** Aborts when the view moves and a newer answer is better than the answer to this question. */
  readonly signal: AbortSignal;
  /** Whether the view has not moved since the question. */
  readonly isCurrent: () => boolean;
}

/** A view that has not moved for this number of milliseconds is at rest. */
const REST = 100;

/**
 * A view that moves, and how far its answers have come. With each move, the questions begin again
 * with the first one, the draft. A draft is always finished, so that a view in motion gets drafts. A
 * later question is given up when the view moves on, if a draft comes sooner than its answer.
 *
 *     draft ──► exact ──► (rest) ──► settled
 *       ▲ each move begins here
 */
export class Gaze<Options = unknown> {
  /** The questions, in order. They may be changed: the change counts from the next move on. */
  stages: readonly Stage<Options>[];
  readonly #wake: () => void;
  readonly #rest = new Rest(REST);
  #turns: readonly Stage<Options>[] = [];
  #next = 0;
  #moves = 0;
  #overtaking: AbortController | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `wake` is called when the view has come to rest and a question waits for this. */
  constructor(stages: readonly Stage<Options>[], wake: () => void) {
    this.stages = stages;
    this.#wake = wake;
  }

  /** The question that is due now. */
  get due(): Stage<Options> | undefined {
    const stage = this.#turns[this.#next];
    if (stage?.atRest !== true || this.#rest.isReached) {
      return stage;
    }
    this.#timer ??= setTimeout(() => {
      this.#timer = undefined;
      this.#wake();
    }, this.#rest.remaining);
    return undefined;
  }

  /** Whether the first question was asked. */
  get isBegun(): boolean {
    return this.#next > 0;
  }

  /** Whether all questions were asked. The answer to the last one may be on its way. */
  get isComplete(): boolean {
    return this.#next >= this.#turns.length;
  }

  /** To be called with the first view and with each move. */
  moved(): void {
    this.#moves += 1;
    this.#next = 0;
    this.#turns = this.stages;
    this.#rest.moved();
    this.#overtaking?.abort();
    this.stop();
  }

  /** The question that is due. It counts as asked from now on. */
  take(): Turn<Options> {
    const stage = this.#turns[this.#next]!;
    const isLater = this.#next > 0;
    this.#next += 1;
    const overtaking = new AbortController();
    this.#overtaking = isLater ? overtaking : undefined;
    const moves = this.#moves;
    return { ...stage, signal: overtaking.signal, isCurrent: () => moves === this.#moves };
  }

  /** To be called when a question was refused: the later ones would be refused, too. */
  refused(turn: Turn<Options>): void {
    if (turn.isCurrent()) {
      this.#next = this.#turns.length;
    }
  }

  /** Nothing wakes any more, until the next move. */
  stop(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }
}
