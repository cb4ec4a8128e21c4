/*
 * The states of the page that are checked for accessibility, and axe-core's result for each. Used by
 * accessibility.test.ts, which requires no violation.
 */
import axe, { type AxeResults } from "axe-core";
import type { BrowserContextOptions, Page } from "playwright-core";
import { poorContrast } from "./contrast.js";

export const TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];

interface Step {
  name: string;
  /** Leads from the previous state to this one. */
  act: (page: Page) => Promise<void>;
}

/** One visit: its steps follow one another on one page. */
export interface Visit {
  name: string;
  query: string;
  options: BrowserContextOptions;
  steps: Step[];
}

const nothing = () => Promise.resolve();
/** A small cloud, but dense enough for a point in the middle of the picture. */
const SMALL = "sample=dragon_res3";
const PHONE: BrowserContextOptions = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const WIDE: BrowserContextOptions = { viewport: { width: 1280, height: 800 } };

const unfolded: Step = {
  name: "every section unfolded",
  act: async (page) => {
    await page.evaluate(() => {
      for (const section of document.querySelectorAll("details")) section.open = true;
    });
  },
};

/** Opens a tool and presses Enter, which picks the point in the middle of the picture, so that the cards are filled. */
const tools: Step[] = ["Pick", "Measure", "Select", "Label", "Compare", "Stations", "Export"].map((name) => ({
  name: `the tool ${name}`,
  act: async (page) => {
    const button = page.locator("#tool-bar").getByRole("button", { name });
    if ((await button.getAttribute("aria-pressed")) !== "true") await button.click();
    if (name === "Stations") {
      await page.getByRole("button", { name: "At the camera" }).click();
      await page.locator("#stations-unseen[data-count]").waitFor();
    }
    if (name === "Pick" || name === "Label") await page.locator("#view").press("Enter");
    if (name === "Label") {
      await page.locator("#label-text").fill("Nose");
      await page.locator("#label-text").press("Enter");
      await page.locator("#view").press("Enter");
    }
  },
}));

const sheetOfKeys: Step = {
  name: "the sheet of keys",
  act: async (page) => {
    await page.locator("#view").press("?");
  },
};

const LESSON: Step = {
  name: "how it works",
  act: async (page) => {
    await page.keyboard.press("Escape");
    await page.locator(".how").evaluate((button: HTMLElement) => button.click());
    await page.locator("#how [role=status]:not(:empty)").waitFor();
  },
};

const JUDGMENT: Step = {
  name: "how right it is",
  act: async (page) => {
    await page.keyboard.press("Escape");
    await page.locator(".right").evaluate((button: HTMLElement) => button.click());
    await page.locator("#right canvas").first().waitFor();
  },
};

const REFUSED: Step = {
  name: "a file that is refused",
  act: async (page) => {
    await page.keyboard.press("Escape");
    await page
      .locator("#file")
      .setInputFiles({ name: "letter.pdf", mimeType: "", buffer: Buffer.from("%PDF-1.7\n\u0000") });
    await page.locator('#status[data-state="error"]').waitFor({ state: "attached" });
  },
};

const LOADING: Step = {
  name: "loading, to be stopped",
  act: async (page) => {
    // The answer never comes.
    await page.route("**/samples/bunny.bin", nothing);
    await page.locator("#sample").selectOption("bunny");
    await page.getByRole("button", { name: "Stop loading" }).waitFor();
  },
};

const sheet: Step = {
  name: "all controls open",
  act: async (page) => {
    await page.getByRole("button", { name: "More controls" }).click();
  },
};

const first: Step = { name: "first view", act: nothing };

export const VISITS: Visit[] = [
  {
    name: "1280 × 800",
    query: `?${SMALL}&hidden=dimmed`,
    options: WIDE,
    steps: [first, unfolded, ...tools, sheetOfKeys, LESSON, JUDGMENT, REFUSED, LOADING],
  },
  { name: "390 × 844", query: `?${SMALL}`, options: PHONE, steps: [first, sheet, unfolded] },
];

export interface Audit {
  result: AxeResults;
  /** Texts with too little contrast in each theme, also over the cloud, where axe-core sees no background. */
  poor: Record<"dark" | "light", string[]>;
}

/**
 * Runs axe-core on the page. Themes differ only in colors, whose contrast is computed in both. The theme of the page comes
 * first, since each change draws the cloud again.
 */
export async function audit(page: Page): Promise<Audit> {
  if (!(await page.evaluate("'axe' in window"))) await page.evaluate(axe.source);
  const result = await page.evaluate(
    (values) => (window as unknown as { axe: typeof axe }).axe.run(document, { runOnly: { type: "tag", values } }),
    TAGS,
  );
  const isDark = (await page.locator(':root[data-theme="dark"]').count()) > 0;
  const poor: Audit["poor"] = { dark: [], light: [] };
  for (const theme of isDark ? (["dark", "light"] as const) : (["light", "dark"] as const)) {
    await page.emulateMedia({ colorScheme: theme });
    await page.locator(`:root[data-theme="${theme}"]`).waitFor();
    poor[theme] = await poorContrast(page);
  }
  return { result, poor };
}

/**
 * The rules that axe-core leaves open here, and why each is met. Any other open rule must be judged by hand.
 */
export const JUDGED: Readonly<Record<string, string>> = {
  "color-contrast":
    "It cannot tell the background of texts over the cloud, or under the bar that stays while a phone’s sheet scrolls. " +
    "`tests/browser/contrast.ts` computes the contrast of every text itself, over the cloud with black and with white behind it: none is below 4.5.",
};
