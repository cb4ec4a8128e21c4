import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";

import { inRoot, root } from "../lib/paths.js";

/** A copy of the crate. Mutants are made there, so that a stopped command leaves no mutant in the sources. */
export const tree = inRoot("target", "mutation", "tree");

const WHAT = ["*.rs", "Cargo.toml", "Cargo.lock", ".cargo", "README.md", "docs/API.md"];
const LIST = "files.txt";

/** Brings the copy up to date. Only files that differ are written, because cargo compiles newer files again. */
export function copyTree(): void {
  const list = ["ls-files", "--cached", "--others", "--exclude-standard", ...WHAT];
  const listed = execFileSync("git", list, { cwd: root, encoding: "utf8" }).trim().split("\n");
  const files = listed.filter((file) => existsSync(inRoot(file)));
  const before = existsSync(join(tree, LIST)) ? readFileSync(join(tree, LIST), "utf8").split("\n") : [];
  for (const file of before) {
    if (!files.includes(file)) rmSync(join(tree, file), { force: true });
  }
  for (const file of files) {
    const [source, target] = [readFileSync(inRoot(file)), join(tree, file)];
    if (existsSync(target) && readFileSync(target).equals(source)) continue;
    mkdirSync(dirname(target), { recursive: true });
    writeFileSync(target, source);
  }
  writeFileSync(join(tree, LIST), files.join("\n"));
  // The tests find the scanned clouds there.
  if (!existsSync(join(tree, "node_modules"))) symlinkSync(inRoot("node_modules"), join(tree, "node_modules"));
}
