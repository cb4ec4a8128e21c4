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
