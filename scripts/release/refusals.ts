import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { sectionOf } from "./changelog.js";
import { statedVersions } from "./version.js";

/** Every reason why the repository in this folder cannot be released. The list is empty if it can. */
export function refusals(root: string): string[] {
  return [...dirtyTree(root), ...disagreement(root), ...changelog(root), ...tag(root)];
}

function dirtyTree(root: string): string[] {
  const changed = git(root, "status", "--porcelain").split("\n").filter(Boolean);
  if (changed.length === 0) return [];
  return [`The tree is not clean: commit or remove ${changed.map((line) => line.slice(3)).join(", ")}.`];
}

function disagreement(root: string): string[] {
  const stated = Object.entries(statedVersions(root));
  const agreed = stated.every(([, version]) => version !== undefined && version === stated[0]?.[1]);
  if (agreed) return [];
  const list = stated.map(([file, version]) => `${file} ${version ?? "none"}`).join(", ");
  return [`The files state different versions: ${list}.`];
}

function changelog(root: string): string[] {
  const version = statedVersions(root)["Cargo.toml"] ?? "";
  const section = sectionOf(readFileSync(join(root, "CHANGELOG.md"), "utf8"), version);
  if (section === undefined) return [`CHANGELOG.md has no section "## ${version}, not yet released".`];
  if (section.body === "") return [`The section ${version} of CHANGELOG.md is empty.`];
  if (section.date === undefined || /^\d{4}-\d\d-\d\d$/.test(section.date)) return [];
  return [`The section ${version} of CHANGELOG.md has "${section.date}" where its day belongs (2026-12-31).`];
}

function tag(root: string): string[] {
  const name = `v${statedVersions(root)["Cargo.toml"] ?? ""}`;
  return git(root, "tag", "--list", name).trim() === "" ? [] : [`The tag ${name} exists: this version was released.`];
}

function git(cwd: string, ...args: string[]): string {
  return execFileSync("git", args, { cwd, encoding: "utf8" });
}
