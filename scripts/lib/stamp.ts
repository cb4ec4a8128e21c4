import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";

import { inRoot, root } from "./run.js";

interface Work {
  /** The name of the stamp. */
  name: string;
  /** The files and directories of the repository on which the work depends. */
  inputs: string[];
  /** The products of the work. If one is missing, the work is done again. */
  outputs: string[];
  /** Directories inside the inputs that hold products. */
  ignore?: string[];
}

/**
 * Does the work, unless its inputs have not changed and its outputs still exist.
 * Contents are compared, not times, because a checkout touches every file.
 */
export async function unlessUnchanged(work: Work, action: () => Promise<void>): Promise<"done" | "unchanged"> {
  const stamp = inRoot("target", "stamps", work.name);
  const digest = digestOf(work);
  const made = work.outputs.every((path) => existsSync(inRoot(path)));
  if (made && existsSync(stamp) && readFileSync(stamp, "utf8") === digest) return "unchanged";
  // If the work fails half-way, the old stamp must not stay beside new outputs.
  rmSync(stamp, { force: true });
  await action();
  mkdirSync(inRoot("target", "stamps"), { recursive: true });
  writeFileSync(stamp, digest);
  return "done";
}

function digestOf(work: Work): string {
  const hash = createHash("sha256");
  const ignored = new Set((work.ignore ?? []).map((path) => inRoot(path)));
  for (const input of work.inputs) addTo(hash, inRoot(input), ignored);
  return hash.digest("hex");
}

function addTo(hash: ReturnType<typeof createHash>, path: string, ignored: Set<string>): void {
  if (ignored.has(path)) return;
  hash.update(`${relative(root, path)}\0`);
  if (!existsSync(path)) return;
  if (!statSync(path).isDirectory()) {
    hash.update(readFileSync(path));
    return;
  }
  for (const name of readdirSync(path).sort()) addTo(hash, join(path, name), ignored);
}
