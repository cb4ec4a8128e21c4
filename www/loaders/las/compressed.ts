import { LoadProblem } from "../problem.ts";
import type { LasHeader } from "./header.ts";
import { LAZ_FORMATS } from "./perf.ts";

/** Refuses formats that the decoder does not support. */
export function checkFormat(name: string, { format }: LasHeader): void {
  if (!LAZ_FORMATS.includes(format))
    throw new LoadProblem(`${name} has compressed points of format ${format}, which this page cannot decompress.`);
}

/** The problem of a file whose compressed points cannot be read. */
export function damaged(name: string): LoadProblem {
  return new LoadProblem(`${name} is broken: its compressed points cannot be decompressed.`);
}
