import { Color } from "three";
import { type Theme, THEMES } from "../view/theme.ts";

/** The theme for the page's own `--canvas` and `--accent`: the light one for a light canvas, else the dark one. */
export function themeOf(element: Element): Theme {
  const style = getComputedStyle(element);
  const [background, accent] = ["--canvas", "--accent"].map((name) => style.getPropertyValue(name).trim()) as [
    string,
    string,
  ];
  const { l: lightness } = new Color(background).getHSL({ h: 0, s: 0, l: 0 });
  return { ...THEMES[lightness > 0.5 ? "light" : "dark"], background, accent };
}
