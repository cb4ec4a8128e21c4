import { fileURLToPath } from "node:url";
import { type Plugin, runnerImport } from "vite";
import { type Action, type Key, KEYS, SHEET, shownKeys, spokenKeys } from "../controls/keys.ts";
import { FORMATS, listed, OTHER_ENDINGS, type Slider, SLIDERS } from "../settings/limits.ts";
import { type Setting, type SettingName, SETTINGS } from "../settings/table.ts";
import { LABELS } from "../settings/settings.ts";

/**
 * Fills index.html from the tables of settings, keys and formats:
 *
 *     <fieldset data-setting="name">       the choices of a setting, as radio buttons
 *     <input data-setting="name">          the ends and the step of its slider
 *     <button data-key="action" title="">  its key, in the title and for screen readers
 *     <dl data-keys>                       the sheet of keys
 *     {{name}}                             a text of TEXTS
 *     <span data-verdict>                  how right the first picture is; each build asks again
 */
export function html(): Plugin {
  return {
    name: "html",
    transformIndexHtml: {
      order: "pre",
      handler: async (page) => {
        const file = fileURLToPath(new URL("verdict.ts", import.meta.url));
        const { module } = await runnerImport<typeof import("./verdict.ts")>(file);
        return filled(page).replace("<span data-verdict>", (tag) => tag + module.verdict);
      },
    },
  };
}

const TEXTS: Record<string, () => string> = {
  keys: () => `${spokenKeys(["orbit", "pan", "zoom"])}. ${spokenKeys(["pick"])}; ${lower(spokenKeys(["sheet"]))}`,
  "formats, or": () => listed(FORMATS, "or"),
  accept: () => [...FORMATS, ...OTHER_ENDINGS].map((name) => `.${name.toLowerCase()}`).join(),
};

export function filled(page: string): string {
  return page
    .replace(
      /(<fieldset[^>]* data-setting="(\w+)"[^>]*>\s*<legend[^>]*>[^<]*<\/legend>)/g,
      (_, opening: string, name: string) => opening + choices(name),
    )
    .replace(/(<input[^>]* data-setting="(\w+)")/g, (_, opening: string, name: string) => opening + ends(name))
    .replace(/ data-key="(\w+)"\s+title="([^"]*)"/g, (_, action: string, title: string) => {
      const key = shownKeys(action as Action).join(" ");
      return ` aria-keyshortcuts="${key}" title="${title} (${key})"`;
    })
    .replace(/(<dl data-keys>)/, (opening) => opening + sheet())
    .replace(/\{\{([^}]+)\}\}/g, (_, name: string) => known(TEXTS[name], name)());
}

function choices(name: string): string {
  const { usual, write } = known(rows()[name], name);
  return Object.entries(known(LABELS[name as SettingName], name))
    .map(([value, label]) => {
      const checked = value === write(usual) ? " checked" : "";
      return `<label><input type="radio" name="${name}" value="${value}"${checked} />${label}</label>`;
    })
    .join("");
}

function ends(name: string): string {
  const { least, most, step } = known((SLIDERS as Record<string, Slider | undefined>)[name], name);
  return ` min="${least}" max="${most}" step="${step}"`;
}

function sheet(): string {
  const keys = (action: Action) => {
    const { shift }: Key = KEYS[action];
    const words = shownKeys(action).map((word) => `<kbd>${word}</kbd>`);
    return words.join(shift ? " + " : " ");
  };
  return SHEET.map(([title, how]) => {
    const text = how
      .replace(/\{(\w+)\}/g, (_, action: string) => keys(action as Action))
      .replace(/\[(\w+)\]/g, "<kbd>$1</kbd>");
    return `<dt>${title}</dt><dd>${text}</dd>`;
  }).join("");
}

function rows(): Record<string, Setting<never> | undefined> {
  return SETTINGS as unknown as Record<string, Setting<never> | undefined>;
}

function known<T>(value: T | undefined, name: string): T {
  if (value === undefined) throw new Error(`index.html names “${name}”, which the tables do not have`);
  return value;
}

function lower(sentence: string): string {
  return sentence.charAt(0).toLowerCase() + sentence.slice(1);
}
