import { byId, isCalm, Segmented, Slider } from "../controls/controls.ts";
import { canLook, LABELS, rowOf, type Settings, type Store, USUAL_SETTINGS } from "../settings/settings.ts";
import { MIDDLE, SLIDERS } from "../settings/limits.ts";
import type { SettingName } from "../settings/table.ts";
import type { TimedView } from "../view/inquiry.ts";
import { type Theme, type ThemeName, THEMES } from "../view/theme.ts";
import type { Cloud } from "../cloud/cloud.ts";
import { colorChoices, type Legend } from "../view/colors.ts";
import { Moves, type Turning } from "../view/moves.ts";
import type { Viewer } from "../view/viewer.ts";
import type { Vector3 } from "three";
import { inLocal } from "../view/framing.ts";

/** How many times as fast as usual the camera walks around a frozen viewpoint. */
const WALK = 5;
/** In radians. */
const ASIDE = 0.9;

/** The verbs over the picture: compare, freeze and walk around, and where the frozen eye goes next. */
export function bindVerbs(viewer: Viewer, store: Store, moves: Moves, turning: Turning): void {
  const compare = byId("compare");
  compare.addEventListener("click", () => store.change({ compare: store.current.compare === null ? MIDDLE : null }));
  byId("open-scan").addEventListener("click", () => byId("file").click());
  const freeze = byId("walk");
  const here = byId("eye-here");
  /** Where the camera looked before. */
  let before: Vector3 | null = null;
  freeze.addEventListener("click", () => {
    const { freeze: eye } = store.current;
    if (!viewer.cloud) return;
    if (eye) {
      const target = before ?? viewer.navigation.target.clone();
      store.change({ freeze: null, hidden: "off" });
      viewer.navigation.flyTo({ at: inLocal(viewer.cloud, eye), target });
      return;
    }
    before = viewer.navigation.target.clone();
    store.change({ freeze: viewer.viewpoint, hidden: "dimmed", compare: null });
    viewer.navigation.goBack(viewer.radius, viewer.stage.shape, () => {
      if (!moves.frozen) return;
      // Without motion, the camera stands at the side at once.
      if (isCalm()) viewer.navigation.turn(ASIDE);
      else turning.begin(WALK);
    });
  });
  here.addEventListener("click", () => store.change({ freeze: viewer.viewpoint }));
  store.follow(({ freeze: frozen, compare: divided }) => {
    compare.setAttribute("aria-pressed", String(divided !== null));
    freeze.setAttribute("aria-pressed", String(frozen !== null));
    freeze.textContent = frozen ? "Unfreeze" : "Freeze and walk around";
    here.hidden = frozen === null;
    // Keys may freeze another cloud later.
    if (!frozen) before = null;
  });
}

/** Settings whose only control is one row of buttons or one slider. The other controls have files of their own. */
const CHOICES = ["hidden", "looks", "surface", "up", "theme"] as const;
const SLIDING = ["size", "fieldOfView"] as const;

/** Settings that change together with another one. With another direction up, a frozen view has no meaning. */
const TOGETHER: Partial<Record<SettingName, Partial<Settings>>> = { up: { freeze: null } };

/** The ids of these controls in index.html. */
const IDS = {
  hidden: "hidden-points",
  looks: "looks",
  surface: "surface",
  up: "up-axis",
  theme: "theme",
  size: "point-size",
  fieldOfView: "field-of-view",
};

export function bindSettings(store: Store): void {
  for (const name of CHOICES) bindChoice(store, name);
  for (const name of SLIDING) bindSlider(store, name);
}

/** A row of buttons, one for each text that the panel offers for the setting. */
function bindChoice(store: Store, name: (typeof CHOICES)[number]): void {
  const row = rowOf(name);
  const change = (text: string) => store.change({ [name]: row.parse(text), ...TOGETHER[name] });
  const choice = new Segmented(IDS[name], LABELS[name], change);
  store.follow((now) => (choice.value = row.write(now[name])));
}

function bindSlider(store: Store, name: (typeof SLIDING)[number]): void {
  const slider = new Slider(IDS[name], SLIDERS[name], (value) => store.change({ [name]: value }));
  store.follow((now) => (slider.value = now[name]));
}

/** The settings in each folded section. */
const SECTIONS: Record<string, (keyof Settings)[]> = {
  "look-section": ["color", "size", "fieldOfView", "up"],
  "advanced-section": ["looks", "surface", "radius"],
};

/** Unfolds the sections with a setting that is not usual: the user must find what changes the picture. */
export function unfoldUnusual(settings: Settings): void {
  for (const [id, names] of Object.entries(SECTIONS)) {
    if (names.some((name) => settings[name] !== USUAL_SETTINGS[name])) byId(id, HTMLDetailsElement).open = true;
  }
}

/** The radius of one hull: automatic, until the slider is moved. The returned function shows that of an answer. */
export function bindRadius(store: Store): (answer: TimedView) => void {
  const slider = new Slider("exponent", SLIDERS.exponent, (exponent) => store.change({ radius: { exponent } }));
  slider.clear();
  const automatic = byId("radius-auto");
  automatic.addEventListener("click", () => store.change({ radius: { rule: "auto" } }));
  const group = byId("radius-choice", HTMLFieldSetElement);
  store.follow(({ radius, inversion }) => {
    automatic.setAttribute("aria-pressed", String("rule" in radius));
    group.disabled = inversion !== "spherical";
    if ("exponent" in radius) slider.value = radius.exponent;
  });
  return ({ question, visibility }) => {
    const { radius, inversion } = store.current;
    const isFound = question.method.radius !== null && inversion === "spherical";
    if (isFound && !("exponent" in radius)) slider.value = visibility.exponent;
  };
}

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

export interface ColorControl {
  /** Offers the attributes by which a cloud can be colored. */
  offer: (cloud: Cloud) => void;
  explain: (legend: Legend | null) => void;
}

/** The choice of colors, and a legend that explains them. */
export function bindColor(store: Store): ColorControl {
  const select = byId("color", HTMLSelectElement);
  const legend = byId("legend");
  select.addEventListener("change", () => store.change({ color: select.value }));
  store.follow(({ color }) => (select.value = color));
  return {
    offer: (cloud) => {
      select.replaceChildren(...colorChoices(cloud).map(({ value, label }) => new Option(label, value)));
      select.value = store.current.color;
    },
    explain: (next) => {
      legend.hidden = next === null;
      legend.replaceChildren(...(next === null ? [] : next.kind === "ramp" ? rampParts(next) : categoryParts(next)));
    },
  };
}

function rampParts({ low, high, colors }: Extract<Legend, { kind: "ramp" }>): Node[] {
  const bar = element("span", "ramp");
  bar.style.background = `linear-gradient(90deg, ${colors.join(", ")})`;
  const digits = Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(high - low || 1))));
  const number = new Intl.NumberFormat("en-US", { maximumFractionDigits: digits });
  return [bar, element("span", "low", number.format(low)), element("span", "high", number.format(high))];
}

function categoryParts({ entries }: Extract<Legend, { kind: "categories" }>): Node[] {
  const list = element("ul", "");
  for (const { label, color, count } of entries) {
    const swatch = element("span", "swatch");
    swatch.style.background = color;
    const item = element("li", "");
    item.append(swatch, label, element("span", "count", count.toLocaleString("en-US")));
    list.append(item);
  }
  return [list];
}

function element(tag: string, name: string, text = ""): HTMLElement {
  const made = document.createElement(tag);
  if (name) made.className = name;
  made.textContent = text;
  return made;
}

/** All controls of the panel: they change the settings, and show them. */
export class Panel {
  /** Shows the radius that an answer was found with. */
  readonly follow: (answer: TimedView) => void;
  readonly #color: ColorControl;
  /** The settings that a reset goes back to. */
  usual: Pick<Settings, "fieldOfView"> = USUAL_SETTINGS;

  /** `opened`: the settings whose sections are open from the beginning. */
  constructor(viewer: Viewer, store: Store, opened: Settings, turning: Turning) {
    this.follow = bindRadius(store);
    bindSettings(store);
    const looks = byId("looks", HTMLFieldSetElement);
    const surface = byId("surface", HTMLFieldSetElement);
    store.follow((now) => {
      looks.disabled = !canLook(now);
      surface.disabled = !canLook(now) || now.looks === 0;
    });
    this.#color = bindColor(store);
    viewer.onLegend = this.#color.explain;
    const moves = new Moves(byId("view", HTMLCanvasElement), viewer, store, () => this.usual);
    bindVerbs(viewer, store, moves, turning);
    bindTheme(store, (theme) => viewer.setTheme(theme));
    unfoldUnusual(opened);

    for (const button of document.querySelectorAll(".reset")) button.addEventListener("click", () => moves.reset());
  }

  /** Prepares the panel for a cloud that is about to be shown. */
  prepare(cloud: Cloud): void {
    this.#color.offer(cloud);
  }
}
