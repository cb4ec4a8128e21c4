import type { Store, ThemeChoice } from "../settings/settings.ts";
import { type Theme, type ThemeName, THEMES } from "../view/theme.ts";
import { byId } from "../controls/dom.ts";
import { Segmented } from "../controls/segmented.ts";

/** The theme that is chosen, or the system's as long as none is: on the page, its marks and, by `apply`, the canvas. */
export function bindTheme(store: Store, apply: (theme: Theme) => void): void {
  const system = matchMedia("(prefers-color-scheme: light)");
  const choice = new Segmented<ThemeChoice>("theme", (theme) => {
    store.change({ theme });
  });
  let shown: ThemeName | null = null;
  const show = () => {
    const { theme } = store.current;
    const name = theme === "system" ? (system.matches ? "light" : "dark") : theme;
    choice.value = theme;
    if (name === shown) return;
    shown = name;
    document.documentElement.dataset["theme"] = name;
    // What is saved of the marks is this element alone.
    document.querySelector<SVGElement>("#marks")!.dataset["theme"] = name;
    // The browser's own bars go with the panel, which is at their side.
    const panel = getComputedStyle(byId("panel")).backgroundColor;
    document.querySelector<HTMLMetaElement>('meta[name="theme-color"]')!.content = panel;
    apply(THEMES[name]);
  };
  store.follow(show);
  system.addEventListener("change", show);
}
