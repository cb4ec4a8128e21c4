// Every example that needs no page and no other language prints the lines in its comments. `tests/browser/examples.test.ts`
// opens the pages, `python/tests/test_documents.py` runs the Python one.
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";

import { promised, root } from "./snippets.js";

const folder = join(root, "examples");
const names = readdirSync(folder).filter((name) => !/^(README.md|index.html|pictures)$/.test(name));

test.each(names.filter((name) => name.endsWith(".mjs")))("%s prints the lines in its comments", (name) => {
  const output = execFileSync(process.execPath, [join(folder, name)], { encoding: "utf8" });
  expect(output.trim().split("\n")).toEqual(promised(readFileSync(join(folder, name), "utf8")));
});

test("visible.rs prints the lines in its comments", () => {
  // Compiled like the native tests, because that is quicker than a release build.
  const run = ["run", "--quiet", "--locked", "--profile", "fuzz", "--example", "visible"];
  const output = execFileSync("cargo", run, { cwd: root, encoding: "utf8" });
  expect(output.trim().split("\n")).toEqual(promised(readFileSync(join(folder, "visible.rs"), "utf8")));
});

test("each example has at most 60 lines, pages 80, and the table lists it", () => {
  const table = readFileSync(join(folder, "README.md"), "utf8");
  for (const name of names) {
    const lines = readFileSync(join(folder, name), "utf8").trimEnd().split("\n").length;
    expect(lines, name).toBeLessThanOrEqual(name.endsWith(".html") ? 80 : 60);
    expect(table).toContain(`](${name})`);
  }
});
