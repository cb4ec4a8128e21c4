// tests/TRUST.md says what the long checks found, and each fault that it names has a test.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, it } from "vitest";

import { TRUST, trust } from "../../scripts/trust/text.js";
import { root } from "../root";

const read = (file: string) => readFileSync(join(root, file), "utf8");

it("holds the results as they are committed: npm run trust writes it", () => {
  expect(read(TRUST)).toBe(trust(root));
});

const faults = [...read("tests/FAULTS.md").matchAll(/\| (tests\/\S+): (.+?) \|$/gm)];

it.each(faults.map(([, file = "", test = ""]) => [test, file]))("a test exists: %s, in %s", (test, file) => {
  expect(read(file).replaceAll("\\", "")).toContain(test);
});

it("reads every row of the faults", () => {
  const rows = read("tests/FAULTS.md")
    .split("\n")
    .filter((line) => line.startsWith("| "));
  expect(faults).toHaveLength(rows.length - 1);
  expect(faults.length).toBeGreaterThan(5);
});
