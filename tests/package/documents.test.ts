// Every snippet of the README and of docs/ is run: JavaScript here, Rust as documentation tests of the crate. Every command that a document names belongs to
// the project, and every link leads to a file.
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";

import { describe, expect, test } from "vitest";

import { blocks, printed, promised, root, scratchFor } from "./snippets";

const DOCUMENTS = [
  ...[
    "README.md",
    "ARCHITECTURE.md",
    "CONTRIBUTING.md",
    "www/README.md",
    "tests/README.md",
    "python/README.md",
    "examples/README.md",
  ],
  ...readdirSync(join(root, "docs"))
    .filter((name) => name.endsWith(".md"))
    .map((name) => `docs/${name}`),
].filter((name) => existsSync(join(root, name)));
const scratch = scratchFor("documents");

describe.each(["README.md", "docs/API.md", "docs/BUNDLERS.md", "docs/CAMERAS.md"])(
  "JavaScript snippets of %s print what they say",
  (document) => {
    test.each(blocks(document, "js").map((code, i) => [i, code] as const))("snippet %i", (i, code) => {
      expect(promised(code).length).toBeGreaterThan(0);
      expect(printed(scratch, i, code)).toEqual(promised(code));
    });
  },
);

test.each(DOCUMENTS)("links of %s lead to files", (document) => {
  const text = readFileSync(join(root, document), "utf8");
  for (const [, target = "", heading] of text.matchAll(/\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)/g)) {
    const file = target === "" ? document : join(dirname(document), target);
    expect(existsSync(join(root, file)), target).toBe(true);
    if (heading !== undefined) expect(anchors(file), target).toContain(heading);
  }
});

/** The names that GitHub gives to the headings of a document. */
function anchors(document: string): string[] {
  return [...readFileSync(join(root, document), "utf8").matchAll(/^#+ (.+)$/gm)].map(([, heading = ""]) =>
    heading
      .toLowerCase()
      .replace(/[^\w\- ]/g, "")
      .replaceAll(" ", "-"),
  );
}

test.each([
  ["README.md", 1300],
  ["ARCHITECTURE.md", 1000],
  ["docs/API.md", 2400],
  ["docs/CAMERAS.md", 800],
  ["docs/COMMAND.md", 650],
  ["docs/MEASURED.md", 1000],
  ["docs/STREAM.md", 600],
  ["docs/VISIBLE.md", 700],
])("%s has at most %i words", (document, most) => {
  const words = readFileSync(join(root, document), "utf8").trim().split(/\s+/);
  expect(words.length).toBeLessThanOrEqual(most);
});

test.each([
  ["users", 12_000, (name: string) => name.startsWith("docs/")],
  ["contributors", 3000, (name: string) => !/^(README|docs|python|examples)/.test(name)],
] as const)("the documents for %s have at most %i words", (_, most, isOne) => {
  const names = [...DOCUMENTS, "tests/TRUST.md", "tests/fuzz/README.md"].filter(isOne);
  const text = names.map((name) => readFileSync(join(root, name), "utf8")).join("\n");
  expect(text.trim().split(/\s+/).length).toBeLessThanOrEqual(most);
});

test("the table of fuzzers has a row for each", () => {
  const found = (file: string, names: RegExp) =>
    [...readFileSync(join(root, file), "utf8").matchAll(names)].flatMap(([, name = ""]) => name.toLowerCase());
  const rows = found("tests/fuzz/README.md", /^\| (`.+?) \|/gm).flatMap((row) => row.match(/\w+/g) ?? []);
  const checks = found("tests/core/checks/mod.rs", /^ {4}check\("(\w+)"/gm);
  const functions = found("scripts/fuzz/fuzzers.ts", /name: "fuzz(\w+)"/g);
  expect(rows.toSorted()).toEqual([...checks, ...functions].toSorted());
});

describe("commands", () => {
  const commands = DOCUMENTS.flatMap((document) => blocks(document, "sh"))
    .flatMap((block) => block.split("\n"))
    .map((line) => line.replace(/#.*/, "").trim())
    .filter((line) => line !== "");
  const inline = DOCUMENTS.flatMap((document) =>
    [...readFileSync(join(root, document), "utf8").matchAll(/`(npm [^`]+)`/g)].map(([, text]) => text ?? ""),
  );

  test("npm commands are scripts of the project", () => {
    const { scripts } = JSON.parse(readFileSync(join(root, "package.json"), "utf8")) as {
      scripts: Record<string, string>;
    };
    const used = [...commands, ...inline]
      .flatMap((line) => line.split("&&"))
      .map((command) => command.trim())
      .filter((command) => command.startsWith("npm ") && !/^npm (install|ci|pack|i|audit|publish)\b/.test(command));
    expect(used.length).toBeGreaterThan(3);
    for (const command of used) {
      const [, name = ""] = /^npm (?:run )?([\w:]+)/.exec(command) ?? [];
      expect(scripts, command).toHaveProperty(name);
    }
  });

  test("the Rust example filters a file", () => {
    const command = commands.find((line) => line.startsWith("cargo run"));
    const [, example = "", args = ""] = /--example (\w+) -- (.*) >/.exec(command ?? "") ?? [];
    writeFileSync(join(scratch, "cloud.xyz"), "0 0 1 a\n0 0 2 b\n1 0 0 c\n");
    const { stdout, status } = spawnSync(
      "cargo",
      [
        "run",
        "--quiet",
        "--locked",
        // Compiled like the native tests, because that is quicker than a release build.
        "--profile",
        "fuzz",
        "--manifest-path",
        join(root, "Cargo.toml"),
        "--example",
        example,
        "--",
        ...args.split(" "),
      ],
      { cwd: scratch, encoding: "utf8", env: { ...process.env, CARGO_TARGET_DIR: join(root, "target") } },
    );
    expect(status).toBe(0);
    expect(stdout).toBe("0 0 2 b\n1 0 0 c\n");
  });
});
