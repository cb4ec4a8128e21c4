/** An error for a file that breaks the rules of its format. The message follows "FILE cannot be read: ". */
export class FormatProblem extends Error {
  override readonly name = "FormatProblem";
  /** How the rest of the file can be read, with `damaged`: without a line, or although the file contradicts itself. */
  rest: "without it" | "anyway" | undefined;
}

const LONGEST_QUOTE = 60;

/** Quotes a line of a file for a message. It is shortened. */
export function quoted(text: string): string {
  const short = text.length > LONGEST_QUOTE ? `${text.slice(0, LONGEST_QUOTE)}…` : text;
  return `"${printable(short)}"`;
}

/**
 * A text in one line. Control characters, which would command a terminal, marks of the direction of
 * writing, which would show it in another order, and halves of characters are replaced.
 */
export function printable(text: string): string {
  return text.replace(/[\p{Cc}\p{Cs}\p{Zl}\p{Zp}\p{Bidi_Control}]/gu, "?");
}

/** @param says what is wrong, for example "has 2 values, and its header promises 3" */
export function lineProblem(line: number, says: string, text?: string): FormatProblem {
  return new FormatProblem(`line ${line} ${says}${text === undefined ? "" : `: ${quoted(text)}`}`);
}

/** @param name the name of the rows: "points", or the name of a PLY element */
export function endsEarly(found: number, count: number, name: string): FormatProblem {
  return new FormatProblem(`it ends after ${found} of the ${count} ${several(name)} that its header promises`);
}

/** The name of the rows in the plural, for a sentence. */
export function several(name: string): string {
  return { points: "points", vertex: "vertices", face: "faces" }[name] ?? `"${name}" elements`;
}

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
  leaveOut(problem: unknown): void {
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
