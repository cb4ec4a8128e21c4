import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";

import { inRoot, root } from "../lib/paths.js";

/** The results of a mutant. `open`: the quick tests missed it, and the complete tests have not run yet. */
export const RESULTS = ["caught", "timeout", "unviable", "missed", "open"] as const;
export type Result = (typeof RESULTS)[number];

const FOLDER = "tests/mutations";
const FILE = `${FOLDER}/rust.tsv`;
const REPORT = `${FOLDER}/RUST.md`;
const [BEGIN, END] = ["<!-- written by npm run mutants -->\n", "<!-- end -->\n"];

/** The file of a mutant, which is named `file:line:column: what`. */
export function fileOf(name: string): string {
  return name.slice(0, name.indexOf(":"));
}

export function readResults(): Map<string, Result> {
  if (!existsSync(inRoot(FILE))) return new Map();
  const lines = readFileSync(inRoot(FILE), "utf8").matchAll(/^(\w+)\t(.+)$/gm);
  return new Map(Array.from(lines, ([, result, name]) => [name!, result as Result]));
}

/** Saves the results of the mutants in `every`, in this order. Other mutants belong to older sources. */
export function saveResults(results: Map<string, Result>, every: string[]): void {
  const lines = every.flatMap((name) => (results.has(name) ? [`${results.get(name)}\t${name}\n`] : []));
  mkdirSync(inRoot(FOLDER), { recursive: true });
  writeFileSync(inRoot(FILE), lines.join(""));
}

/** Writes the part of the report between its two marks again. The text around it is written by hand. */
export function writeTable(results: Map<string, Result>, every: string[]): void {
  const commit = execFileSync("git", ["rev-parse", "--short", "HEAD"], { cwd: root, encoding: "utf8" }).trim();
  const files = [...new Set(every.map((name) => fileOf(name)))];
  const row = (title: string, names: string[]) => {
    const count = (result: Result | undefined) => names.filter((name) => results.get(name) === result).length;
    return `| ${[title, names.length, ...RESULTS.map(count), count(undefined)].join(" | ")} |`;
  };
  const table = [
    `| file | mutants | ${RESULTS.join(" | ")} | not tried |`,
    `|---|${"---:|".repeat(RESULTS.length + 2)}`,
    ...files.map((file) =>
      row(
        `\`${file}\``,
        every.filter((name) => fileOf(name) === file),
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
