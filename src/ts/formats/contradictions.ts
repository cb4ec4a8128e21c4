import { FormatProblem } from "./problem.js";

/** What a file says against itself. It is refused, or read with notes. */
export class Contradictions {
  readonly notes: string[] = [];
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
    if (!this.notes.includes(says)) this.notes.push(says);
  }
}
