import type { Page } from "playwright-core";

/**
 * Visible texts with too little contrast to their background (WCAG 1.4.3: 4.5, large texts 3). Over the cloud the
 * background counts as black or white, whichever is worse. So a text there needs a backing, or in an SVG an outline.
 */
export async function poorContrast(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    type Color = [number, number, number, number];
    const context = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true })!;
    // Reads any CSS color through a canvas: red, green and blue from 0 to 255, opacity from 0 to 1.
    const parse = (css: string): Color => {
      context.clearRect(0, 0, 1, 1);
      context.fillStyle = css;
      context.fillRect(0, 0, 1, 1);
      const [r, g, b, a] = context.getImageData(0, 0, 1, 1).data;
      return [r!, g!, b!, a! / 255];
    };
    const over = (top: Color, below: Color): Color =>
      [0, 1, 2].map((i) => top[3] * top[i]! + (1 - top[3]) * below[i]!).concat(1) as Color;
    const luminance = (color: Color) => {
      const [r, g, b] = color
        .slice(0, 3)
        .map((value) => (value <= 10.31475 ? value / 3294.6 : ((value / 255 + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r! + 0.7152 * g! + 0.0722 * b!;
    };
    const ratio = (a: Color, b: Color) => {
      const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
      return (high! + 0.05) / (low! + 0.05);
    };
    /** The possible backgrounds of an element. */
    const behind = (element: Element): Color[] => {
      const layers: Color[] = [];
      for (let at: Element | null = element; at && at.id !== "stage"; at = at.parentElement) {
        const layer = parse(getComputedStyle(at).backgroundColor);
        layers.push(layer);
        if (layer[3] === 1) break;
      }
      const cloud: Color[] = [
        [0, 0, 0, 1],
        [255, 255, 255, 1],
      ];
      return cloud.map((ground) => layers.reduceRight((below, layer) => over(layer, below), ground));
    };

    const found: string[] = [];
    const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walk.nextNode(); node; node = walk.nextNode()) {
      const element = node.parentElement!;
      const text = node.textContent!.trim();
      // Disabled controls and texts for screen readers only are exempt.
      if (
        text === "" ||
        element.closest("script, style, noscript, option, .unseen, :disabled, .idle") ||
        !element.checkVisibility()
      ) {
        continue;
      }
      const style = getComputedStyle(element);
      const svg = element instanceof SVGElement;
      const edge = svg && style.stroke !== "none" ? [parse(style.stroke)] : null;
      const worst = Math.min(
        ...(edge ?? behind(element)).map((ground) => ratio(parse(svg ? style.fill : style.color), ground)),
      );
      const size = Number.parseFloat(style.fontSize);
      const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
      if (worst < (large ? 3 : 4.5)) {
        found.push(
          `“${text.slice(0, 30)}” in ${element.tagName}#${element.id || element.parentElement!.id}: ${worst.toFixed(2)}`,
        );
      }
    }
    return found;
  });
}
