// Makes the types, the reader's rows and the documents' table of options from src/options.json.
import { readFileSync, writeFileSync } from "node:fs";

import { inRoot } from "../lib/run.js";

/** One option. What it is says exactly one of `number`, `words`, `whole`, `truth`, `call` and `type`; a number may have words. */
interface Option {
  /** A number; the core checks the rest of its range. */
  number?: { least?: number; above?: number; most?: number };
  /** These words, instead of a number or alone. */
  words?: string[];
  /** An integer, from the first to the second. */
  whole?: [least: number, most: number];
  /** true or false; false says the same as leaving it out. */
  truth?: true;
  /** A function. */
  call?: true;
  /** A type of TypeScript, which has a reader of its own. */
  type?: string;
  required?: true;
  /** Needs a cloud of dimension 3. */
  space?: true;
  /** Goes only with this one. */
  needs?: string;
  excludes?: string[];
  /** The command has it as `--name VALUE`, with this word for its value. */
  flag?: string;
  /** What the command's help says, where it is not `short`. */
  help?: string;
  /** One line, for tables and helps. */
  short: string;
  /** All that there is to say. */
  doc: string;
}

interface Group {
  /** The name of the type in TypeScript. */
  interface: string;
  /** The group whose options go with these. */
  extends?: string;
  doc: string;
  options: Record<string, Option>;
}

const TABLE = "src/options.json";
export const OPTION_ROWS = "src/ts/query/option-rows.ts";
const FLAGS = "src/ts/cli/flags.ts";
const DOCUMENT = "docs/API.md";

/** Writes the files that follow from the table of options, where they differ. */
export function makeOptions(): void {
  const groups = JSON.parse(readFileSync(inRoot(TABLE), "utf8")) as Record<string, Group>;
  write(OPTION_ROWS, typescript(groups));
  write(FLAGS, flags(groups));
  write(DOCUMENT, withTable(readFileSync(inRoot(DOCUMENT), "utf8"), groups["view"]!));
}

function write(path: string, text: string): void {
  let before = "";
  try {
    before = readFileSync(inRoot(path), "utf8");
  } catch {
    // It is made for the first time.
  }
  if (text !== before) writeFileSync(inRoot(path), text);
}

function typescript(groups: Record<string, Group>): string {
  const names = Object.entries(groups);
  return [
    `// Made from ${TABLE} by scripts/build/options.ts.`,
    `import type { Camera } from "./camera.js";`,
    `import type { Row } from "./options.js";`,
    `import type { Viewpoint } from "./positions.js";`,
    `import type { Cone, Inversion, ResolvedInversion, Within } from "./option-types.js";`,
    "",
    ...names.flatMap(([, group]) => interfaceOf(group, groups)),
    ...names.flatMap(([name, { extends: base, options }]) => [
      `export const ${constant(name)} = {`,
      ...(base === undefined ? [] : [`  ...${constant(base)},`]),
      ...Object.entries(options).map(([option, row]) => `  ${option}: ${JSON.stringify(rowOf(row))},`),
      "} as const satisfies Record<string, Row>;",
      "",
    ]),
  ].join("\n");
}

const constant = (group: string) => `${group.toUpperCase()}_ROWS`;

function interfaceOf({ interface: name, extends: base, doc, options }: Group, groups: Record<string, Group>): string[] {
  return [
    ...comment(doc, ""),
    `export interface ${name}${base === undefined ? "" : ` extends ${groups[base]!.interface}`} {`,
    ...Object.entries(options).flatMap(([option, row]) => [
      ...comment(row.doc, "  "),
      `  ${option}${row.required ? `: ${typeOf(row)}` : `?: ${typeOf(row)} | undefined`};`,
    ]),
    "}",
    "",
  ];
}

function comment(text: string, indent: string): string[] {
  return [`${indent}/**`, ...text.split("\n").map((line) => `${indent} * ${line}`.trimEnd()), `${indent} */`];
}

function typeOf({ type, truth, whole, number, words = [] }: Option): string {
  if (type !== undefined) return type.includes("=>") ? `(${type})` : type;
  if (truth) return "boolean";
  if (whole && whole[1] - whole[0] < 4) {
    return Array.from({ length: whole[1] - whole[0] + 1 }, (_, i) => whole[0] + i).join(" | ");
  }
  return [...(number || whole ? ["number"] : []), ...words.map((word) => JSON.stringify(word))].join(" | ");
}

/** What the reader needs of an option. */
function rowOf({ number, words, whole, truth, call, space, needs, excludes }: Option): object {
  return { number, words, whole, truth, call, space, needs, excludes };
}

/** The command's options: a name, the word for its value, and what the help says. */
function flags(groups: Record<string, Group>): string {
  const lines = Object.entries(groups).flatMap(([group, { options }]) => {
    const rows = Object.entries(options).flatMap(([name, { flag, help, short }]) =>
      flag === undefined
        ? []
        : [`  [${[name, flag, help ?? plain(short)].map((text) => JSON.stringify(text)).join(", ")}],`],
    );
    return rows.length === 0 ? [] : [`export const ${group.toUpperCase()}_FLAGS = [`, ...rows, "] as const;", ""];
  });
  return [`// Made from ${TABLE} by scripts/build/options.ts.`, ...lines].join("\n");
}

/** A line of a document without its marks and links. */
function plain(markdown: string): string {
  return markdown.replaceAll(/ ?\(\[[^\]]*\]\([^)]*\)\)|[`"]/g, "");
}

/** The document with the table of options between its marks. */
function withTable(text: string, { options }: Group): string {
  const rows = Object.entries(options).map(([name, { short }]) => `| \`${name}\` | ${short} |`);
  const table = ["| option | effect |", "|---|---|", ...rows].join("\n");
  const [begin, end] = ["<!-- options of a view, from src/options.json -->\n", "\n<!-- end of options -->"];
  const [from, to] = [text.indexOf(begin), text.indexOf(end)];
  if (from < 0 || to < from) throw new Error(`${DOCUMENT} has no place for the table of options.`);
  return text.slice(0, from + begin.length) + table + text.slice(to);
}
