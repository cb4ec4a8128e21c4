// The tables of settings and keys in the documents must match the page.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { docs } from "../../www/build/docs-plugin.js";
import { ELEMENT_KEYS, KEYS, type Key, shownKeys } from "../../www/controls/keys.js";
import { ATTRIBUTE_NAMES, rowOf } from "../../www/element/attributes.js";
import { SAMPLES } from "../../www/samples/samples.js";
import { type AnyParameter, PARAMETERS, type Setting, SETTINGS } from "../../www/settings/table.js";
import { root } from "../root.js";

type AnyRow = Setting<never>;

const settings = Object.entries(SETTINGS) as unknown as [string, AnyRow][];
const parameters = Object.entries(PARAMETERS) as unknown as [keyof typeof PARAMETERS, AnyParameter][];

/** The rows of a table in a document, after its head. */
function rowsOf(document: string, name: string): string[][] {
  const whole = readFileSync(join(root, document), "utf8");
  const from = whole.indexOf(`<!-- ${name} -->`);
  expect(from).toBeGreaterThan(0);
  const lines = whole.slice(from).split("\n\n")[1]!.trim().split("\n").slice(2);
  return lines.map((line) =>
    line
      .slice(1, -1)
      .split("|")
      .map((cell) => cell.trim()),
  );
}

/** What stands in a table is sentences of the document, but for names, values, and usual values. */
function compare(rows: string[][], expected: { name: string; values?: string; usual?: string }[]): void {
  expect(rows.map(([name]) => name)).toEqual(expected.map(({ name }) => `\`${name}\``));
  for (const [i, { name, values, usual }] of expected.entries()) {
    const [, is, written, without = ""] = rows[i]!;
    expect(is, name).not.toBe("");
    if (values !== undefined) expect(written, name).toBe(values);
    if (usual !== undefined && /^`[^`]*`$/.test(without)) expect(without, name).toBe(`\`${usual}\``);
  }
}

const usualOf = ({ write, usual }: AnyRow) => write(usual);

test("the parameters of the address in the document are the page's", () => {
  const all = [
    ...parameters.map(([name, { values }]) => ({ name, values })),
    ...settings.map(([, row]) => ({ name: row.parameter, values: row.values, usual: usualOf(row) })),
  ];
  const attributes = all.map(({ name }) => name).filter((name) => (ATTRIBUTE_NAMES as string[]).includes(name));
  compare(rowsOf("docs/ADDRESS.md", "parameters of the address"), [
    { name: "sample", values: SAMPLES.map(({ name }) => name).join(", ") },
    { name: "src" },
    ...all.filter(({ name }) => !attributes.includes(name)),
  ]);
  // They are told once, with the element.
  const said = readFileSync(join(root, "docs/ADDRESS.md"), "utf8");
  for (const name of attributes) expect(said).toContain(`\`${name}\``);
});

test("the attributes of the element in the document are the element's", () => {
  const rows = rowsOf("docs/EMBED.md", "attributes of the element");
  compare(
    rows,
    ATTRIBUTE_NAMES.map((name) => {
      const { written, setting } = rowOf(name);
      const usual = setting && usualOf(SETTINGS[setting] as unknown as AnyRow);
      return { name, values: written?.values ?? "", ...(usual !== undefined && { usual }) };
    }),
  );
  for (const { name } of SAMPLES) expect(rows[1]![1]).toContain(name);
});

test("the keys of the element in the document are the element's", () => {
  const keys = ELEMENT_KEYS.map((action) => {
    const { does, shift }: Key = KEYS[action];
    const shown = shownKeys(action).map((key) => `\`${key}\``);
    return [shown.join(shift ? " + " : " "), does];
  });
  expect(rowsOf("docs/EMBED.md", "keys of the element")).toEqual(keys);
});

test("every setting has a parameter of its own, and its usual value can be written and read again", () => {
  const rows = settings.map(([, row]) => row);
  const names = [...rows.map((row) => row.parameter), ...parameters.map(([name]) => name)];
  expect(new Set(names).size).toBe(names.length);
  // If there is no frozen viewpoint, divider or part, the address does not mention it.
  const unwritten = ["freeze", "compare", "box", "without"];
  for (const [name, { usual, write, parse }] of settings) {
    if (!unwritten.includes(name)) expect((parse as (text: string) => unknown)(write(usual)), name).toEqual(usual);
  }
});

test("no two actions of the page's canvas have the same key", () => {
  const elsewhere = new Set(["light", "divide"]);
  const pressed = Object.entries(KEYS)
    .filter(([action]) => !elsewhere.has(action))
    .flatMap(([, { keys, ...key }]) => keys.map((each) => ("shift" in key ? `Shift ${each}` : each)));
  expect(new Set(pressed).size).toBe(pressed.length);
});

test("the documents are served beside the page, and their links lead to other ones", () => {
  type Handler = (request: { url: string }, response: object, next: () => void) => void;
  let handle: Handler | undefined;
  const { configureServer } = docs() as unknown as { configureServer: (server: object) => void };
  configureServer({ config: { base: "/" }, middlewares: { use: (handler: Handler) => (handle = handler) } });
  const get = (url: string) => {
    let body: string | undefined;
    handle!({ url }, { writeHead: () => ({ end: (given: string) => (body = given) }) }, () => undefined);
    return body;
  };
  const [seen, waiting] = [new Set<string>(), ["index.html"]];
  for (let name = waiting.pop(); name !== undefined; name = waiting.pop()) {
    if (seen.has(name)) continue;
    seen.add(name);
    const page = get(`/docs/${name}`);
    expect(page, name).toMatch(/^<!doctype html>/);
    for (const [, link] of page!.matchAll(/href="(\w+\.html)/g)) waiting.push(link!);
  }
  expect(seen.size).toBeGreaterThan(10);
  expect(get("/docs/none.html")).toBeUndefined();
});
