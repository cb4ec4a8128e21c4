import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";

import { inRoot, root } from "../lib/paths.js";

export const out = inRoot("target", "mutation");

/** A copy of the crate. Mutants are made there, so that a stopped command leaves no mutant in the sources. */
export const tree = join(out, "tree");

const WHAT = ["tests/*.rs", "examples/*.rs", "Cargo.toml", "Cargo.lock", "README.md", "docs/API.md"];

/** Brings all but `src` of the copy up to date. Only files that differ are written, because cargo compiles newer files again. */
export function copyTree(): void {
  const list = ["ls-files", "--cached", "--others", "--exclude-standard", ...WHAT];
  const listed = execFileSync("git", list, { cwd: root, encoding: "utf8" }).trim().split("\n");
  for (const file of listed.filter((file) => existsSync(inRoot(file)))) {
    const [source, target] = [readFileSync(inRoot(file)), join(tree, file)];
    if (existsSync(target) && readFileSync(target).equals(source)) continue;
    mkdirSync(dirname(target), { recursive: true });
    writeFileSync(target, source);
  }
  // The tests find the scanned clouds there.
  if (!existsSync(join(tree, "node_modules"))) symlinkSync(inRoot("node_modules"), join(tree, "node_modules"));
}
