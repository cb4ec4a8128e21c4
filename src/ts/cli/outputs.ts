// Refuses outputs that would replace an input, or each other.
import { type BigIntStats, fstatSync } from "node:fs";
import { realpath, stat } from "node:fs/promises";
import { basename, dirname, join, resolve } from "node:path";

import { linkedFrom, STANDARD_OUTPUT } from "./files.js";
import { UsageProblem } from "./values.js";

interface Names {
  inputs: readonly string[];
  outputs: readonly string[];
  /** Whether an output may replace an input. */
  overwrite: boolean;
}

/** Two names stand for one file if its device and its number there are the same, so links count, too. */
export async function checkOutputs({ inputs, outputs, overwrite }: Names): Promise<void> {
  const read = new Map<string, string>();
  if (!overwrite) for (const name of inputs) read.set((await fileOf(name)) ?? "", name);
  const written = new Map<string, string>();
  for (const name of outputs) {
    const file = await fileOf(name);
    if (file === undefined) continue;
    const [input, other] = [read.get(file), written.get(file)];
    if (input !== undefined) {
      throw new UsageProblem(`${said(name)} is the same file as the input ${input}; --overwrite replaces it`);
    }
    if (other !== undefined) throw new UsageProblem(`${name} and ${other} are the same file`);
    written.set(file, name);
  }
}

/** The regular file that a name stands for, or the place where it will be made. Undefined for a pipe or a device. */
async function fileOf(name: string): Promise<string | undefined> {
  const place = name === "-" ? STANDARD_OUTPUT : await linkedFrom(name).catch(() => name);
  const found: BigIntStats | undefined =
    typeof place === "number"
      ? fstatSync(place, { bigint: true })
      : await stat(place, { bigint: true }).catch(() => undefined);
  if (found !== undefined) return found.isFile() ? `${found.dev}:${found.ino}` : undefined;
  const folder = await realpath(dirname(String(place))).catch(() => resolve(dirname(String(place))));
  return join(folder, basename(String(place)));
}

function said(output: string): string {
  return output === "-" ? "standard output" : output;
}
