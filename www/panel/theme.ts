import { byId } from "../controls/dom.ts";
import type { Store } from "../settings/store.ts";
import { type Theme, type ThemeName, THEMES } from "../view/theme.ts";

/** Gives the chosen theme, or the system's, to the page, to its marks and, by `apply`, to the canvas. */
export function bindTheme(store: Store, apply: (theme: Theme) => void): void {
  const system = matchMedia("(prefers-color-scheme: light)");
  let shown: ThemeName | null = null;
  const show = () => {
    const { theme } = store.current;
    const name = theme === "system" ? (system.matches ? "light" : "dark") : theme;
    if (name === shown) return;
    shown = name;
    document.documentElement.dataset["theme"] = name;
    // The exported picture has this element's style alone.
    document.querySelector<SVGElement>("#marks")!.dataset["theme"] = name;
    // The browser's own bars have the color of the panel, which they lie beside.
    const panel = getComputedStyle(byId("panel")).backgroundColor;
    document.querySelector<HTMLMetaElement>('meta[name="theme-color"]')!.content = panel;
    apply(THEMES[name]);
  };
  store.follow(show);
  system.addEventListener("change", show);
}
