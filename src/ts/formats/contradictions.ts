import { FormatProblem } from "./problem.js";

/**
 * What a file says against itself. It is refused where points would be invented or lost, or read with notes if that is asked
 * for. What is only odd is noted.
 */
export class Contradictions {
  readonly #notes: string[] = [];
  /** How many lines are left out, and what the first one says. */
  #lines = 0;
  #first = "";
  readonly #isRead: boolean;

  /** @param isRead whether such files are read */
  constructor(isRead: boolean | undefined) {
    this.#isRead = isRead === true;
  }

  /** @param says a sentence without a period, for example "it ends early" */
  add(says: string): void {
    if (!this.#isRead) {
      const problem = new FormatProblem(`${says}; it may be damaged`);
      problem.rest = "anyway";
      throw problem;
    }
    this.note(says);
  }

  note(says: string): void {
    if (!this.#notes.includes(says)) this.#notes.push(says);
  }

  /** A line that is no point. It is left out, if such files are read. */
  leaveOut(problem: unknown): undefined {
    if (!(problem instanceof FormatProblem)) throw problem;
    problem.rest = "without it";
    if (!this.#isRead) throw problem;
    if (this.#lines++ === 0) this.#first = problem.message;
  }

  get linesLeftOut(): number {
    return this.#lines;
  }

  get notes(): string[] {
    const what = this.#lines === 1 ? "one line is left out" : `${this.#lines} lines are left out, the first`;
    return this.#lines === 0 ? this.#notes : [...this.#notes, `${what}: ${this.#first}`];
  }
}
