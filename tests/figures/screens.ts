/*
 * Pictures of the page in every mode, for a person to judge: at three sizes, in both themes. They are written to a new
 * folder of the system for temporary files: one picture each, and contact sheets of them.
 */
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import type { BrowserContextOptions, Page } from "playwright-core";
import sharp from "sharp";

import { LESSON, LOADING, REFUSED } from "../browser/accessibility.js";
import { root } from "../root.js";
import type { Size, Studio } from "./studio.js";

type Act = (page: Page) => Promise<void>;

interface Mode {
  name: string;
  query: string;
  act?: Act;
}

interface Screen {
  name: string;
  options: BrowserContextOptions & { viewport: Size };
  /** A contact sheet's columns and rows, and the width of a picture on it. */
  sheet: { columns: number; rows: number; width: number };
}

const SCREENS: Screen[] = [
  { name: "1440", options: { viewport: { width: 1440, height: 900 } }, sheet: { columns: 3, rows: 3, width: 620 } },
  { name: "1024", options: { viewport: { width: 1024, height: 640 } }, sheet: { columns: 3, rows: 3, width: 620 } },
  {
    name: "390",
    options: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 },
    sheet: { columns: 6, rows: 2, width: 310 },
  },
];
const THEMES = ["dark", "light"] as const;

const DRAGON = "?sample=dragon_res3";
const OCTREE = "ranged/octree.copc.laz";

const press =
  (name: string): Act =>
  async (page) => {
    const button = page.getByRole("button", { name, exact: true });
    await button.waitFor({ state: "attached" });
    await button.evaluate((element: HTMLElement) => {
      element.click();
    });
  };
/** Shows the controls. On a phone they are under the cloud. */
const unfolded =
  (section: string): Act =>
  async (page) => {
    await page.evaluate((title) => {
      document.getElementById("panel")!.classList.add("open");
      const wanted = [...document.querySelectorAll("summary")].find(({ textContent }) => textContent === title)!;
      (wanted.parentElement as HTMLDetailsElement).open = true;
      wanted.scrollIntoView();
    }, section);
  };
/** On a phone, the controls are folded before and after the act. */
const withPanel =
  (act: Act): Act =>
  async (page) => {
    const fold = (isOpen: boolean) =>
      page.locator("#panel").evaluate((panel, force) => panel.classList.toggle("open", force), isOpen);
    await fold(true);
    await act(page);
    await fold(false);
  };
const pick: Act = async (page) => {
  await press("Pick")(page);
  await page.locator("#view").press("Enter");
};

const MODES: Mode[] = [
  { name: "first visit", query: "" },
  { name: "guide", query: "", act: press("Show me") },
  { name: "visible", query: DRAGON },
  { name: "dimmed", query: `${DRAGON}&hidden=dimmed` },
  { name: "shown", query: `${DRAGON}&hidden=shown` },
  { name: "room", query: "?sample=room" },
  { name: "street", query: "?sample=street" },
  { name: "compare all", query: `${DRAGON}&compare=0.5` },
  { name: "compare z-buffer", query: `${DRAGON}&compare=0.5&against=zbuffer` },
  { name: "compare truth", query: "?sample=bunny&compare=0.5&against=surface" },
  { name: "surface", query: `${DRAGON}&show=surface` },
  { name: "light", query: `${DRAGON}&light=0.2,0.3,0.2&light=-0.2,0.3,0.1&soft=0.1` },
  { name: "at least two", query: `${DRAGON}&viewpoints=two` },
  { name: "best of six", query: `${DRAGON}&radius=search` },
  { name: "frozen", query: `${DRAGON}&freeze=-0.5,0.3,0.1&hidden=dimmed` },
  { name: "stations", query: "?sample=bunny&station=0,5,20,North&station=15,6,0,East", act: press("Stations") },
  { name: "pick", query: "?sample=tile", act: pick },
  { name: "measure", query: "?sample=bunny&measure=100,900&measure=300,1200", act: press("Measure") },
  { name: "area", query: "?sample=bunny&area=100,900,300,1200", act: press("Measure") },
  { name: "profile", query: "?sample=bunny&profile=100,900,2", act: press("Measure") },
  { name: "select", query: "?sample=bunny&select=0-8o", act: press("Select") },
  { name: "label", query: "?sample=bunny&label=900,A+place+on+the+back&label=300,Ear", act: press("Label") },
  { name: "export", query: "?sample=bunny", act: press("Export") },
  { name: "keys", query: "?sample=bunny", act: press("Keys") },
  { name: "lesson", query: DRAGON, act: withPanel(LESSON.act) },
  { name: "information", query: "?sample=tile", act: unfolded("Information") },
  { name: "look", query: "?sample=tile&color=classification", act: unfolded("Look") },
  { name: "advanced", query: DRAGON, act: unfolded("Advanced") },
  { name: "embedded", query: `${DRAGON}&embed=1&hidden=dimmed` },
  { name: "error", query: "?sample=bunny", act: REFUSED.act },
  { name: "loading", query: DRAGON, act: withPanel(LOADING.act) },
  { name: "stream", query: `?src=${OCTREE}&stream=1100` },
];

/** Takes all pictures, or those that HPR_MODES and HPR_SCREENS name: "select,profile", "390". Returns the folder. */
export async function takeScreens(studio: Studio): Promise<string> {
  const [only, screens] = ["HPR_MODES", "HPR_SCREENS"].map((name) => process.env[name]?.split(","));
  const folder = mkdtempSync(join(tmpdir(), "page-"));
  studio.serve(OCTREE, readFileSync(join(root, "tests/browser/fixtures/octree.copc.laz")));
  const modes = MODES.filter(({ name }) => only?.includes(name) ?? true);
  for (const screen of SCREENS.filter(({ name }) => screens?.includes(name) ?? true)) {
    const taken = new Map(THEMES.map((theme) => [theme, [] as Tile[]]));
    for (const mode of modes) {
      console.error(`${screen.name}: ${mode.name}`);
      await studio.visit(mode.query, { ...screen.options, colorScheme: "dark" }, async (page) => {
        await page.locator("#tools").waitFor({ state: "attached" });
        await mode.act?.(page);
        for (const theme of THEMES) {
          await page.emulateMedia({ colorScheme: theme });
          // The page fades from one answer to the next, and draws the new theme in its next frame.
          await page.waitForTimeout(500);
          const png = await page.screenshot({ timeout: 120_000 });
          taken.get(theme)!.push({ name: mode.name, png });
          writeFileSync(join(folder, `${screen.name}-${theme}-${mode.name.replaceAll(" ", "-")}.png`), png);
        }
      });
    }
    for (const [theme, tiles] of taken) await writeSheets(join(folder, `sheet-${screen.name}-${theme}`), tiles, screen);
  }
  return folder;
}

interface Tile {
  name: string;
  png: Buffer;
}

/** Contact sheets: small pictures in rows. They stand in the order of the modes. */
async function writeSheets(file: string, tiles: readonly Tile[], { options, sheet }: Screen): Promise<void> {
  const { columns, rows, width } = sheet;
  const { viewport } = options;
  const height = Math.round((width * viewport.height) / viewport.width);
  const gap = 6;
  for (let from = 0; from < tiles.length; from += columns * rows) {
    const some = tiles.slice(from, from + columns * rows);
    const parts = some.map(async ({ png }, i) => ({
      input: await sharp(png).resize(width, height).toBuffer(),
      left: (i % columns) * (width + gap),
      top: Math.floor(i / columns) * (height + gap),
    }));
    const lines = Math.ceil(some.length / columns);
    const size = { width: columns * (width + gap), height: lines * (height + gap) };
    await sharp({ create: { ...size, channels: 3, background: "#777" } })
      .composite(await Promise.all(parts))
      .png()
      .toFile(`${file}-${from / (columns * rows) + 1}.png`);
  }
}
