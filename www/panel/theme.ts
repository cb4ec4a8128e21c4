import { byId } from "../controls/dom.ts";
import type { Store } from "../settings/store.ts";
import { type Theme, type ThemeName, THEMES } from "../view/theme.ts";

/** Applies the chosen theme, or the theme of the system, to the page, its marks and the canvas (by `apply`). */
export function bindTheme(store: Store, apply: (theme: Theme) => void): void {
  const system = matchMedia("(prefers-color-scheme: light)");
  let shown: ThemeName | null = null;
  const show = () => {
    const { theme } = store.current;
    const name = theme === "system" ? (system.matches ? "light" : "dark") : theme;
    if (name === shown) return;
    shown = name;
    document.documentElement.dataset["theme"] = name;
    // An exported picture takes its style from this element alone.
    document.querySelector<SVGElement>("#marks")!.dataset["theme"] = name;
    // The browser's own bars lie beside the panel, so they have its color.
    const panel = getComputedStyle(byId("panel")).backgroundColor;
    document.querySelector<HTMLMetaElement>('meta[name="theme-color"]')!.content = panel;
    apply(THEMES[name]);
  };
  store.follow(show);
  system.addEventListener("change", show);
}
