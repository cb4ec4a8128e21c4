import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { inRoot, root } from "../lib/paths.js";
import { Problem, run } from "../lib/run.js";
import { out } from "./tree.js";

/** The list of all mutants, for the program that puts them into the sources. */
export const listFile = join(out, "mutants.json");

export interface Mutant {
  /** `file:line:column: what` */
  name: string;
  file: string;
  /** Stays the same while the function stays the same, wherever it is in the file. */
  key: string;
}

interface Place {
  line: number;
  column: number;
}

interface Listed {
  name: string;
  file: string;
  replacement: string;
  span: { start: Place };
  function: { function_name: string; span: { start: Place; end: Place } } | null;
}

/** Writes the list of all mutants into a file, and returns it. */
export async function listMutants(): Promise<Mutant[]> {
  const { ok, output } = await run("cargo-mutants", ["mutants", "--list", "--json", "--dir", root], {
    show: "nothing",
  });
  if (!ok) throw new Problem(`The mutants could not be listed:\n${output}`);
  mkdirSync(out, { recursive: true });
  writeFileSync(listFile, output);
  const sources = new Map<string, string[]>();
  return (JSON.parse(output) as Listed[]).map((listed) => {
    const { name, file } = listed;
    const lines = sources.get(file) ?? readFileSync(inRoot(file), "utf8").split("\n");
    sources.set(file, lines);
    return { name, file, key: keyOf(listed, lines) };
  });
}

function keyOf({ name, file, replacement, span: { start }, function: around }: Listed, lines: string[]): string {
  // Outside functions, the name has to do.
  if (around === null) return name;
  const { line } = around.span.start;
  const text = lines.slice(line - 1, around.span.end.line);
  const facts = [file, around.function_name, ...text, start.line - line, start.column, replacement];
  return createHash("sha256").update(facts.join("\n")).digest("hex").slice(0, 16);
}
