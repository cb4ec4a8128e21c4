// The tables of settings and keys in the documents must match the page. After a change of the page,
// `HPR_WRITE=1 npx vitest run tests/package/page-documents.test.ts` updates the tables.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { ELEMENT_KEYS, KEYS, type Key, shownKeys } from "../../www/controls/keys.js";
import { ATTRIBUTE_NAMES, rowOf } from "../../www/element/attributes.js";
import { ATTRIBUTE_WORDS } from "../../www/element/words.js";
import { SAMPLES } from "../../www/samples/samples.js";
import { type AnyParameter, PARAMETERS, type Setting, type SettingName, SETTINGS } from "../../www/settings/table.js";
import { PARAMETER_WORDS, SETTING_WORDS } from "../../www/settings/words.js";
import { root } from "../root.js";

type AnyRow = Setting<never>;

const settings = Object.entries(SETTINGS) as unknown as [SettingName, AnyRow][];
const parameters = Object.entries(PARAMETERS) as unknown as [keyof typeof PARAMETERS, AnyParameter][];

function table(head: readonly string[], rows: readonly (readonly string[])[]): string {
  const line = (cells: readonly string[]) => `| ${cells.join(" | ")} |`;
  return [line(head), `|${"---|".repeat(head.length)}`, ...rows.map(line)].join("\n");
}

/** The words for a missing setting. If there are no words, its usual value. */
function usualOf(name: SettingName): string {
  const { write, usual } = SETTINGS[name] as unknown as AnyRow;
  return SETTING_WORDS[name].without ?? `\`${write(usual)}\``;
}

const BLOCKS: Record<string, { document: string; text: () => string }> = {
  "parameters of the address": {
    document: "docs/ADDRESS.md",
    text: () => {
      const names = SAMPLES.map(({ name }) => name).join(", ");
      const clouds = [
        ["`sample`", "a cloud of the page", names, SAMPLES[0]!.name],
        ["`src`", "a file on the web; CORS must allow it", "an address", ""],
      ];
      const others = parameters.map(([name, { values }]) => {
        const { is, without = "" } = PARAMETER_WORDS[name];
        return [`\`${name}\``, is, values, without];
      });
      const rows = settings.map(([name, { parameter, values }]) => [
        `\`${parameter}\``,
        SETTING_WORDS[name].is,
        values,
        usualOf(name),
      ]);
      return table(["parameter", "sets", "values", "without it"], [...clouds, ...others, ...rows]);
    },
  },
  "attributes of the element": {
    document: "docs/EMBED.md",
    text: () =>
      table(
        ["attribute", "is", "values", "without it"],
        ATTRIBUTE_NAMES.map((name) => {
          const { written, setting } = rowOf(name);
          const { is, without = setting ? usualOf(setting) : "" } = ATTRIBUTE_WORDS[name];
          return [`\`${name}\``, is, written?.values ?? "", without];
        }),
      ),
  },
  "keys of the element": {
    document: "docs/EMBED.md",
    text: () =>
      table(
        ["keys", "do"],
        ELEMENT_KEYS.map((action) => {
          const { does, shift }: Key = KEYS[action];
          const shown = shownKeys(action).map((key) => `\`${key}\``);
          return [shown.join(shift ? " + " : " "), does!];
        }),
      ),
  },
};

test.for(Object.keys(BLOCKS))("the %s in the document match the page", (name) => {
  const { document, text } = BLOCKS[name]!;
  const [begin, end] = [`<!-- ${name} -->\n\n`, `\n\n<!-- end -->`];
  const file = join(root, document);
  const whole = readFileSync(file, "utf8");
  const from = whole.indexOf(begin) + begin.length;
  const to = whole.indexOf(end, from);
  expect(whole).toContain(begin);
  if (process.env["HPR_WRITE"]) writeFileSync(file, whole.slice(0, from) + text() + whole.slice(to));
  else expect(whole.slice(from, to)).toBe(text());
});

test("every setting has a parameter of its own, and its usual value can be written and read again", () => {
  const rows = settings.map(([, row]) => row);
  const names = [...rows.map((row) => row.parameter), ...parameters.map(([name]) => name)];
  expect(new Set(names).size).toBe(names.length);
  // If there is no light, no frozen viewpoint or no divider, the address does not mention it.
  const unwritten = ["lights", "freeze", "compare"];
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
