// When `npm run release` refuses, in repositories made for it.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, beforeEach, expect, it } from "vitest";

import { dated, sectionOf } from "../../scripts/release/changelog.js";
import { refusals } from "../../scripts/release/refusals.js";

const CHANGELOG = "# Changelog\n\n## 1.2.0, not yet released\n\n- New.\n\n## 1.1.0, 2026-01-31\n\n- Old.\n";

let folder: string;

const git = (...args: string[]) => execFileSync("git", args, { cwd: folder, stdio: "pipe" });
const write = (file: string, text: string) => {
  writeFileSync(join(folder, file), text);
};
const commit = () => {
  git("add", "--all");
  git("-c", "user.name=Test", "-c", "user.email=test@example.org", "commit", "--quiet", "--message", "Change");
};

beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), "hpr-release-"));
  git("init", "--quiet");
  write(
    "Cargo.toml",
    '[package]\nname = "hidden-point-removal"\nversion = "1.2.0"\n\n[dependencies]\nversion = "9.9.9"\n',
  );
  write("Cargo.lock", '[[package]]\nname = "hidden-point-removal"\nversion = "1.2.0"\n');
  write("package.json", JSON.stringify({ version: "1.2.0" }));
  write("package-lock.json", JSON.stringify({ version: "1.2.0", packages: { "": { version: "1.2.0" } } }));
  write("CHANGELOG.md", CHANGELOG);
  commit();
});

afterEach(() => {
  rmSync(folder, { recursive: true });
});

it("finds nothing wrong with a repository that is ready", () => {
  expect(refusals(folder)).toEqual([]);
});

it("refuses changed and new files", () => {
  write("package.json", JSON.stringify({ version: "1.2.0", private: true }));
  write("new.txt", "");
  expect(refusals(folder)).toEqual(["The tree is not clean: commit or remove package.json, new.txt."]);
});

it.each([
  ["Cargo.toml", '[package]\nname = "hidden-point-removal"\nversion = "1.1.0"\n', /Cargo\.toml 1\.1\.0, /],
  ["Cargo.lock", '[[package]]\nname = "hidden-point-removal"\nversion = "1.1.0"\n', /Cargo\.lock 1\.1\.0, /],
  ["package.json", '{ "version": "1.1.0" }', /package\.json 1\.1\.0, /],
  [
    "package-lock.json",
    '{ "version": "1.1.0", "packages": { "": { "version": "1.1.0" } } }',
    /package-lock\.json 1\.1\.0\.$/,
  ],
  [
    "package-lock.json",
    '{ "version": "1.2.0", "packages": { "": { "version": "1.1.0" } } }',
    /package-lock\.json none\.$/,
  ],
])("refuses another version in %s", (file, text, says) => {
  write(file, text);
  commit();
  const [first] = refusals(folder);
  expect(first).toMatch(/^The files state different versions: /);
  expect(first).toMatch(says);
});

it.each([
  [
    "no section",
    "# Changelog\n\n## 1.1.0, 2026-01-31\n\n- Old.\n",
    'CHANGELOG.md has no section "## 1.2.0, not yet released".',
  ],
  ["an empty section", CHANGELOG.replace("- New.\n", ""), "The section 1.2.0 of CHANGELOG.md is empty."],
  [
    "no day",
    CHANGELOG.replace("not yet released", "soon"),
    'The section 1.2.0 of CHANGELOG.md has "soon" where its day belongs (2026-12-31).',
  ],
])("refuses a changelog with %s", (_, text, says) => {
  write("CHANGELOG.md", text);
  commit();
  expect(refusals(folder)).toEqual([says]);
});

it("refuses a version that has its tag", () => {
  git("tag", "v1.2.0");
  expect(refusals(folder)).toEqual(["The tag v1.2.0 exists: this version was released."]);
});

it("names every reason at once", () => {
  write("package.json", '{ "version": "1.3.0" }');
  write("CHANGELOG.md", "# Changelog\n");
  expect(refusals(folder)).toHaveLength(3);
});

it("writes the day into the heading of the version alone", () => {
  const text = dated(CHANGELOG, "1.2.0", "2026-12-31");
  expect(sectionOf(text, "1.2.0")).toEqual({ date: "2026-12-31", body: "- New." });
  expect(sectionOf(text, "1.1.0")).toEqual({ date: "2026-01-31", body: "- Old." });
});
