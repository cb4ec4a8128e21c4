// A figure, and the layout of its panels on one sheet.
import sharp from "sharp";

import type { Shot, Size, Studio } from "./studio.js";

export interface Figure {
  /** The name of its file, without the extension. */
  name: string;
  /** Where its file goes, instead of tests/figures. */
  folder?: string;
  title: string;
  /** The caption in Markdown: what to see, the viewpoint, R and the number of points. */
  caption: string;
  png: Buffer;
}

/** Makes figures. If their data is missing: none, and a message. */
export type Maker = (studio: Studio) => Promise<Figure[]>;

export interface Panel {
  label: string;
  png: Buffer;
}

/** A panel of a sheet with two columns, in CSS pixels. */
export const PANEL: Size = { width: 480, height: 360 };
/** A panel of a sheet with three columns. */
export const NARROW: Size = { width: 320, height: 300 };

const STYLE = `
  body { margin: 0; display: grid; gap: 2px; background: #343a43; font: 600 15px system-ui, sans-serif; color: #e8eaed; }
  figure { margin: 0; background: #14161a; }
  figcaption { padding: 8px 12px; min-height: 18px; }
  img { display: block; }
`;
const LIGHT = "body { background: #c8ccd2; color: #1f2328 } figure { background: #fff }";

/** Panels of one size in rows, each with its label above. */
export async function sheet(
  studio: Studio,
  panels: Panel[],
  columns: number,
  { width, height }: Size,
  theme: "dark" | "light" = "dark",
): Promise<Buffer> {
  const cells = panels.map(({ label, png }) => {
    const source = `data:image/png;base64,${png.toString("base64")}`;
    return `<figure><figcaption>${label}</figcaption><img src="${source}" width="${width}" height="${height}"></figure>`;
  });
  const html = `<style>${STYLE} ${theme === "light" ? LIGHT : ""} body { grid-template-columns: repeat(${columns}, ${width}px) }</style>${cells.join("")}`;
  return studio.print(html, columns * width + 2 * (columns - 1), async (page) => {
    await page.evaluate(() => Promise.all(Array.from(document.images, (image) => image.decode())));
  });
}

/** Uses a palette, which keeps a picture of many thousand points small. */
export function small(png: Buffer): Promise<Buffer> {
  return sharp(png).png({ palette: true, colours: 96, dither: 0.5, effort: 10 }).toBuffer();
}

const whole = new Intl.NumberFormat("en-US", { maximumFractionDigits: 0 });

export function count(value: string | number | undefined): string {
  return whole.format(Number(value));
}

/** A number for people: three digits. */
export function digits(value: string | number | undefined): string {
  return String(Number(Number(value).toPrecision(3)));
}

/** The viewpoint in the file's coordinates. */
export function from({ status }: Shot): string {
  return `(${(status["viewpoint"] ?? "").split(",").map(digits).join(", ")})`;
}

/** R, and its exponent. */
export function radiusOf({ status }: Shot): string {
  return `R = ${digits(status["radius"])} (exponent ${Number(status["exponent"]).toFixed(2)})`;
}
