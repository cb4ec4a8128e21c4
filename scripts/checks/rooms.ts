// A file of the Rust core may import only from its own room or from a room upstream, and imports may not form a circle in any
// crate. rustc would accept both.
import { readFileSync, readdirSync } from "node:fs";
import { relative } from "node:path";

import { FAIL, PASS, type Check } from "./check.js";
import { inRoot, print } from "../lib/run.js";

/** The rooms from upstream to downstream. `lib` lists the public names; `wasm` uses only them and its own names. */
const ROOMS = ["base", "cloud", "flip", "hull", "view", "answers", "dimensions", "lib", "wasm"];

/** The crates besides the core. None has rooms. */
const CRATES = ["src/files", "python/src"];

export const roomsCheck: Check = {
  title: "Rust: imports go downward",
  part: "lint",
  run: () => {
    const imports = importsOf("src");
    const others = CRATES.map((crate) => importsOf(crate));
    const wrong = [...upward(imports), ...[imports, ...others].flatMap(circles)];
    for (const line of wrong) print(`${line}\n`);
    return Promise.resolve(wrong.length === 0 ? PASS : { ...FAIL, failures: wrong });
  },
};

type Imports = Map<string, Set<string>>;

/** What each file of a crate imports. Their names begin in its folder. */
function importsOf(crate: string): Imports {
  const others = CRATES.map((other) => relative(crate, other));
  const names = readdirSync(inRoot(crate), { recursive: true, encoding: "utf8" }).filter(
    (name) => name.endsWith(".rs") && !others.some((other) => name.startsWith(`${other}/`)),
  );
  const all = new Set(names);
  return new Map(names.map((name) => [name, importsOfFile(inRoot(crate, name), name, all)]));
}

function importsOfFile(file: string, name: string, files: Set<string>): Set<string> {
  const text = readFileSync(file, "utf8")
    .replace(/\n#\[cfg\(test\)\]\nmod tests \{[^]*/, "")
    .replace(/\/\/.*/g, "")
    .replace(/\bpub\(in [^)]*\)/g, "pub");
  const targets = new Set<string>();
  const here = name.replace(/(\/mod)?\.rs$/, "").split("/");
  const add = (path: string[]) => {
    const target = fileOf(path, here, files);
    if (target !== undefined && target !== name) targets.add(target);
  };
  const uses = /\buse ([^;]+);/g;
  for (const [, tree] of text.matchAll(uses)) branches(tree!).forEach(add);
  for (const [path] of text.replace(uses, "").matchAll(/\bcrate(::\w+)+/g)) add(path.split("::"));
  return targets;
}

/** The paths of a use tree: a::{b, c::{d, e}} is a::b, a::c::d and a::c::e. */
function branches(tree: string): string[][] {
  const open = tree.indexOf("{");
  if (open < 0) return [tree.trim().split(/::|\s/)];
  const stem = tree.slice(0, open).trim().split("::").filter(Boolean);
  const parts: string[] = [""];
  let depth = 0;
  for (const letter of tree.slice(open + 1, tree.lastIndexOf("}"))) {
    if (letter === "," && depth === 0) parts.push("");
    else parts.push(parts.pop()! + letter);
    depth += letter === "{" ? 1 : letter === "}" ? -1 : 0;
  }
  return parts
    .filter((part) => part.trim() !== "")
    .flatMap(branches)
    .map((branch) => [...stem, ...branch]);
}

/** The file that a path leads to, or undefined if it is not in this crate. */
function fileOf(path: string[], here: string[], files: Set<string>): string | undefined {
  const isRoot = here.length === 1 && here[0] === "lib";
  let at: string[];
  if (path[0] === "crate") {
    at = [];
  } else if (path[0] === "self") {
    at = isRoot ? [] : here;
  } else if (path[0] === "super") {
    at = here.slice(0, -1);
  }
  // A mod.rs or lib.rs names the files in its own folder.
  else {
    at = isRoot ? [] : here;
    path = ["self", ...path];
  }
  let file = at.length === 0 && path[0] !== "self" ? "lib.rs" : undefined;
  for (const name of path.slice(1)) {
    at = [...at, name];
    const found = [`${at.join("/")}.rs`, `${at.join("/")}/mod.rs`].find((name) => files.has(name));
    if (found === undefined) break;
    file = found;
  }
  return file;
}

function roomOf(file: string): number {
  return ROOMS.indexOf(file.split("/")[0]!.replace(/\.rs$/, ""));
}

function upward(imports: Imports): string[] {
  return [...imports].flatMap(([file, targets]) =>
    [...targets]
      .filter((target) => roomOf(file) < 0 || roomOf(target) > roomOf(file))
      .map((target) => `src/${file} imports from downstream: src/${target}`),
  );
}

function circles(imports: Imports): string[] {
  const found: string[] = [];
  const done = new Set<string>();
  const visit = (file: string, path: string[]) => {
    const start = path.indexOf(file);
    if (start >= 0) found.push(`a circle of imports: ${[...path.slice(start), file].join(" → ")}`);
    if (start >= 0 || done.has(file)) return;
    for (const target of imports.get(file) ?? []) visit(target, [...path, file]);
    done.add(file);
  };
  for (const file of imports.keys()) visit(file, []);
  return found;
}
