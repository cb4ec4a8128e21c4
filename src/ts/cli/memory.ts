import { FormatProblem } from "../formats/problem.js";

/** Runs an allocation in JavaScript's memory. If it is refused, the file cannot be read. */
export function allocating<T>(what: string, allocate: () => T): T {
  try {
    return allocate();
  } catch (cause) {
    throw new FormatProblem(`no memory for ${what}`, { cause });
  }
}
