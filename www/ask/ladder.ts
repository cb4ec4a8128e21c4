import type { Viewpoint } from "../settings/settings.ts";
import { isSamePlace, isSameView, isSearched, isSlow, kindOf, stagesOf, type ViewQuestion } from "./question.ts";

/** Below this number of points, one hull takes about as long as a frame, so nobody waits for a draft. */
const DRAFTS_FROM = 50_000;
/** After a draft, one hull is asked if the viewpoint has not moved for this number of milliseconds. */
export const PAUSE = 40;

/** A question that is due, and whether it is given up as soon as the viewpoint moves on. */
interface Due {
  question: ViewQuestion;
  isFirst: boolean;
}

/**
 * Which question comes next on the way to the final answer for the newest view: see `stagesOf`. While the viewpoint
 * moves, only the first stage is asked, again and again.
 */
export class Ladder {
  readonly #size: number;
  readonly #drafts: boolean;
  #wanted: ViewQuestion | null = null;
  #answered: ViewQuestion | null = null;
  /** The last question about one hull that was answered. */
  #hull: ViewQuestion | null = null;
  #asked: Due | null = null;
  #overtaking = new AbortController();

  /** `count` and `size`: the number of points of the cloud, and its radius. */
  constructor(count: number, size: number) {
    this.#size = size;
    this.#drafts = count >= DRAFTS_FROM;
  }

  /** The question whose answer is final. */
  get wanted(): ViewQuestion | null {
    return this.#wanted;
  }

  /** Whether the final answer is there, or was refused. */
  get isFinal(): boolean {
    return this.#wanted !== null && this.#answered !== null && this.#isSame(this.#wanted, this.#answered);
  }

  /** Sets the view to be answered. Gives up a later stage of another view. */
  want(final: ViewQuestion): void {
    if (this.#wanted && this.#isSame(final, this.#wanted)) return;
    this.#wanted = final;
    const asked = this.#asked;
    if (asked && !asked.isFirst && !this.#stages.some((stage) => this.#isSame(stage, asked.question)))
      this.#overtaking.abort();
  }

  /** The next question. `null`: there is none, or it waits until the viewpoint has rested for longer. */
  next({ isPaused, isAtRest }: { isPaused: boolean; isAtRest: boolean }): Due | null {
    if (!this.#wanted || this.isFinal) return null;
    const stages = this.#stages;
    const at = this.#begin(stages);
    const question = stages[at]!;
    if (isSlow(question.method) && !isAtRest) return null;
    if (at > 0 && !isPaused) return null;
    return { question, isFirst: at === 0 };
  }

  /** To be called when a question is asked. Returns the signal that gives it up; the first stage has none. */
  take(due: Due): AbortSignal | undefined {
    this.#asked = due;
    this.#overtaking = new AbortController();
    return due.isFirst ? undefined : this.#overtaking.signal;
  }

  answered(question: ViewQuestion): void {
    this.#asked = null;
    this.#answered = question;
    if (kindOf(question) === "operator") this.#hull = question;
  }

  /** A refused question counts as the final answer: it is not asked again. */
  refused(): void {
    this.#asked = null;
    this.#answered = this.#wanted;
  }

  get #stages(): ViewQuestion[] {
    return stagesOf(this.#wanted!, this.#drafts);
  }

  /** The number of the stage that comes next. */
  #begin(stages: ViewQuestion[]): number {
    const last = this.#answered;
    if (!last || !this.#isHere(last.viewpoint)) return 0;
    const reached = stages.findIndex((stage) => this.#isSame(stage, last));
    if (reached >= 0) return reached + 1;
    // Only settings have changed. A draft, or another radius, would show points that the picture no longer has.
    if (isSearched(this.#wanted!.method)) return stages.length - 1;
    const next = stages.findIndex(({ draft }) => !draft);
    const isKnown = this.#hull !== null && this.#isSame(stages[next]!, this.#hull);
    return isKnown ? Math.min(next + 1, stages.length - 1) : next;
  }

  #isHere(viewpoint: Viewpoint): boolean {
    return isSamePlace(viewpoint, this.#wanted!.viewpoint, this.#size);
  }

  #isSame(a: ViewQuestion, b: ViewQuestion): boolean {
    return isSameView(a, b, this.#size);
  }
}
