// Makes the types, the readers' rows and the documents' table of options from src/options.json.
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
  const view = groups["view"]!;
  writePart(DOCUMENT, "<!-- options of a view, from src/options.json -->", tableOf(view), "<!-- end of options -->");
  writePart(
    "python/hidden_point_removal/types.py",
    "# Options of a view, from src/options.json.",
    pythonTypes(view),
    "# End of options.",
  );
  writePart(
    "python/hidden_point_removal/__main__.py",
    "# Flags, from src/options.json.",
    ["FLAGS = [", ...flagsOf(view).map((row) => `    (${row}),`), "]"].join("\n"),
    "# End of flags.",
  );
  writePart(
    "python/src/options.rs",
    "// Options of a view, from src/options.json.",
    pythonTable(view),
    "// End of options.",
  );
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
    `import type { ImageCamera } from "./camera.js";`,
    `import type { Row } from "./options.js";`,
    `import type { Viewpoint } from "./positions.js";`,
    `import type { Cone, Inversion, ResolvedInversion, Within, Without } from "./option-types.js";`,
    "",
    ...waysOf(groups["view"]!),
    ...names.flatMap(([, group]) => typeOfGroup(group, groups)),
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

/** The largest sets of options that go together: what is left when each of two that exclude each other had to go. */
function waysOf({ options }: Group): string[] {
  const split = (names: string[]): string[][] => {
    const one = names.find((name) => options[name]!.excludes?.some((other) => names.includes(other)));
    if (one === undefined) return [names];
    const excluded = options[one]!.excludes!;
    return [[one], excluded].flatMap((gone) => split(complete(names.filter((name) => !gone.includes(name)))));
  };
  const complete = (names: string[]) => names.filter((name) => names.includes(options[name]!.needs ?? name));
  const ways = split(Object.keys(options)).map((names) => {
    const without = Object.keys(options).filter((name) => !names.includes(name));
    const needed = new Set(names.flatMap((name) => options[name]!.needs ?? []));
    const given = Array.from(needed, (name) => ` & { ${name}: ${typeOf(options[name]!)} }`).join("");
    return `  | (Without<${without.map((name) => JSON.stringify(name)).join(" | ")}>${given})`;
  });
  return [
    ...comment("Which options of a view go together. Others throw `option`.", ""),
    "export type OneWay =",
    ...new Set(ways),
    "  ;",
    "",
  ];
}

/** A type, because an interface cannot extend one of which some options exclude others. */
function typeOfGroup({ interface: name, extends: base, doc, options }: Group, groups: Record<string, Group>): string[] {
  return [
    ...comment(doc, ""),
    `export type ${name} = ${base === undefined ? "OneWay" : groups[base]!.interface} & {`,
    ...Object.entries(options).flatMap(([option, row]) => [
      ...comment(row.doc, "  "),
      `  ${option}${row.required ? `: ${typeOf(row)}` : `?: ${typeOf(row)} | undefined`};`,
    ]),
    "};",
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

/** The options of the commands: a name, the word for its value, and what the help says. */
function flagsOf({ options }: Group): string[] {
  return Object.entries(options).flatMap(([name, { flag, help, short }]) =>
    flag === undefined ? [] : [[name, flag, help ?? plain(short)].map((text) => JSON.stringify(text)).join(", ")],
  );
}

function flags(groups: Record<string, Group>): string {
  const lines = Object.entries(groups).flatMap(([name, group]) => {
    const rows = flagsOf(group).map((row) => `  [${row}],`);
    return rows.length === 0 ? [] : [`export const ${name.toUpperCase()}_FLAGS = [`, ...rows, "] as const;", ""];
  });
  return [`// Made from ${TABLE} by scripts/build/options.ts.`, ...lines].join("\n");
}

/** A line of a document without its marks and links. */
function plain(markdown: string): string {
  return markdown.replaceAll(/ ?\(\[[^\]]*\]\([^)]*\)\)|[`"]/g, "");
}

/** The table of a document. */
function tableOf({ options }: Group): string {
  const rows = Object.entries(options).map(([name, { short }]) => `| \`${name}\` | ${short} |`);
  return ["| option | effect |", "|---|---|", ...rows].join("\n");
}

/** Writes what stands between two lines of a file. */
function writePart(path: string, begin: string, made: string, end: string): void {
  const text = readFileSync(inRoot(path), "utf8");
  const [from, to] = [text.indexOf(`${begin}\n`) + begin.length + 1, text.indexOf(`\n${end}`)];
  if (from === begin.length || to < from) throw new Error(`${path} has no place for the table of options.`);
  write(path, text.slice(0, from) + made + text.slice(to));
}

// Python.

/** What Python calls the types that have a reader of their own, and how its messages name their values. */
const TYPES: Record<string, [type: string, values: string]> = {
  "Inversion | ResolvedInversion": ["Inversion", '"spherical", {"power": number} or {"exponential": number or "auto"}'],
  Within: ["Within", "a dictionary of distance, box and mask"],
};
/** Open3D's method has it as an argument of its own. */
const RADIUS = "radius";
const WIDTH = 116;

/** The types of keyword arguments. */
function pythonTypes({ options }: Group): string {
  const field = (name: string): string[] => {
    const row = options[name]!;
    return [`    ${name}: ${kindOf(row).type} | None`, ...wrapped(`    """${said(row)}"""`)];
  };
  return [
    "class OtherOptions(Threads, total=False):",
    '    """The options of a view besides the radius."""',
    "",
    ...Object.keys(options)
      .filter((name) => name !== RADIUS)
      .flatMap(field),
    "",
    "",
    "class Options(OtherOptions, total=False):",
    '    """The options of a view. An option that is None counts as left out."""',
    "",
    ...field(RADIUS),
  ].join("\n");
}

/** Names, values and exclusions for the reader, and the texts of help(). */
function pythonTable({ options }: Group): string {
  const rows = Object.entries(options);
  const text = rows.map(([name, row]) => wrapped(`${name}: ${kindOf(row).values}. ${said(row)}`).join("\n"));
  return [
    "#[rustfmt::skip]",
    `const OPTIONS: [(&str, &str, &[&str]); ${rows.length}] = [`,
    ...rows.map(([name, row]) => {
      const excludes = (row.excludes ?? []).map((one) => `"${one}"`).join(", ");
      return `    ("${name}", r#"${kindOf(row).values}"#, &[${excludes}]),`;
    }),
    "];",
    "",
    "macro_rules! signature {",
    "    () => {",
    `        "${rows.map(([name, row]) => `, ${name}=${row.truth ? "False" : "None"}`).join("")}"`,
    "    };",
    "}",
    "",
    "macro_rules! about_options {",
    "    () => {",
    `        r##"${text.join("\n")}"##`,
    "    };",
    "}",
  ].join("\n");
}

function kindOf({ type, truth, whole, number, words = [] }: Option): { type: string; values: string } {
  if (type !== undefined) {
    const [own, values] = TYPES[type] ?? [type, type];
    return { type: own, values };
  }
  if (truth) return { type: "bool", values: "True or False" };
  const numbers = whole && Array.from({ length: whole[1] - whole[0] + 1 }, (_, i) => whole[0] + i);
  const named = words.map((word) => JSON.stringify(word));
  const literals = [...(numbers ?? []), ...named];
  return {
    type: [...(number ? ["float"] : []), ...(literals.length > 0 ? [`Literal[${literals.join(", ")}]`] : [])].join(
      " | ",
    ),
    values: listed([...(number ? ["a number"] : []), ...(numbers ?? []), ...named]),
  };
}

const listed = (names: unknown[]) =>
  names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} or ${names.at(-1) as string}`;

/** The short text with dictionaries in the place of objects, and documents in that of links. */
function said({ short }: Option): string {
  const text = short
    .replaceAll(/\[([^\]]+)\]\(\1\)/g, "docs/$1")
    .replaceAll(/\{ (.*?) \}/g, (_, inner: string) => `{${inner.replaceAll(/(^|, )(\w+)(?=:|,|$)/g, '$1"$2"')}}`);
  return `${text[0]!.toUpperCase()}${text.slice(1)}${text.endsWith(".") ? "" : "."}`;
}

/** Lines of at most `WIDTH` letters; all but the first are indented. */
function wrapped(text: string): string[] {
  const lines = [""];
  for (const word of text.split(/(?<=\S) /)) {
    if (lines.at(-1)!.length + 1 + word.length > WIDTH) lines.push(`    ${word}`);
    else lines.push([lines.pop(), word].filter(Boolean).join(" "));
  }
  return lines;
}
