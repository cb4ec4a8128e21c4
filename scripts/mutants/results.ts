import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";

import { inRoot, root } from "../lib/paths.js";
import type { Mutant } from "./list.js";

/**
 * The results of a mutant. `unreached`: no test reaches its place. `open`: the quick tests missed it, and the others
 * have not run yet. `explained`: the report says why no test can find it. This is written by hand.
 */
export const RESULTS = ["caught", "timeout", "unviable", "explained", "missed", "unreached", "open"] as const;
export type Result = (typeof RESULTS)[number];

const FOLDER = "tests/mutations";
const FILE = `${FOLDER}/rust.tsv`;
const REPORT = `${FOLDER}/RUST.md`;
const [BEGIN, END] = ["<!-- written by npm run mutants -->\n", "<!-- end -->\n"];

/** The results by the keys of the mutants. */
export type Results = Map<string, Result>;

export function readResults(): Results {
  if (!existsSync(inRoot(FILE))) return new Map();
  const lines = readFileSync(inRoot(FILE), "utf8").matchAll(/^(\w+)\t.+\t(.+)$/gm);
  return new Map(Array.from(lines, ([, result, key]) => [key!, result as Result]));
}

/** Saves the results of the mutants in `every`, in this order. Other mutants belong to older sources. */
export function saveResults(results: Results, every: Mutant[]): void {
  const lines = every.flatMap(({ name, key }) => (results.has(key) ? [`${results.get(key)}\t${name}\t${key}\n`] : []));
  mkdirSync(inRoot(FOLDER), { recursive: true });
  writeFileSync(inRoot(FILE), lines.join(""));
}

/** Writes the part of the report between its two marks again. The text around it is written by hand. */
export function writeTable(results: Results, every: Mutant[]): void {
  const commit = execFileSync("git", ["rev-parse", "--short", "HEAD"], { cwd: root, encoding: "utf8" }).trim();
  const files = [...new Set(every.map(({ file }) => file))];
  const row = (title: string, mutants: Mutant[]) => {
    const count = (result: Result | undefined) => mutants.filter(({ key }) => results.get(key) === result).length;
    return `| ${[title, mutants.length, ...RESULTS.map(count), count(undefined)].join(" | ")} |`;
  };
  const table = [
    `| file | mutants | ${RESULTS.join(" | ")} | not tried |`,
    `|---|${"---:|".repeat(RESULTS.length + 2)}`,
    ...files.map((file) =>
      row(
        `\`${file}\``,
        every.filter((mutant) => mutant.file === file),
      ),
    ),
    row("all", every),
  ];
  const written = `${BEGIN}Sources of ${commit}.\n\n${table.join("\n")}\n${END}`;
  const report = existsSync(inRoot(REPORT))
    ? readFileSync(inRoot(REPORT), "utf8")
    : `# Mutants of the core\n\n${BEGIN}${END}`;
  const [before = "", rest = ""] = report.split(BEGIN);
  writeFileSync(inRoot(REPORT), `${before}${written}${rest.split(END)[1] ?? ""}`);
  console.log(`\n${table.join("\n")}\n${REPORT}`);
}
