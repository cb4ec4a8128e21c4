import { isCalm } from "../controls/controls.ts";
import { ELEMENT_KEYS, spokenKeys } from "../controls/keys.ts";
import style from "./element.css?inline";
import { Color } from "three";
import { type Theme, THEMES } from "../view/theme.ts";

/** The element's shadow tree: the picture and the words over it. Each has a slot and a part that the page can use. */
export class Frame {
  readonly #root: ShadowRoot;
  readonly #bar = make("progress", "progress");
  readonly #loading = words("loading");
  readonly #error = words("error");
  readonly #fallback = make("div", "fallback");
  #canvas: HTMLCanvasElement | null = null;
  #label: string | null = null;

  constructor(root: ShadowRoot) {
    this.#root = root;
    // A style element would be refused by a page whose security policy does not allow it.
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(style);
    root.adoptedStyleSheets = [sheet];
    this.#bar.max = 1;
    this.#bar.ariaLabel = "Loading";
    this.#fallback.className = "fallback";
    this.#fallback.append(document.createElement("slot"));
    this.#bar.hidden = this.#loading.hidden = this.#error.hidden = this.#fallback.hidden = true;
    root.append(this.#bar, this.#loading, this.#error, this.#fallback);
  }

  /** Makes a new canvas each time: a canvas that has been given up cannot draw again. */
  newCanvas(): HTMLCanvasElement {
    const canvas = make("canvas", "canvas");
    canvas.tabIndex = 0;
    this.#canvas?.remove();
    this.#canvas = canvas;
    this.#root.prepend(canvas);
    this.setLabel(this.#label);
    return canvas;
  }

  removeCanvas(): void {
    this.#canvas?.remove();
    this.#canvas = null;
  }

  setLabel(label: string | null): void {
    this.#label = label;
    if (this.#canvas) this.#canvas.ariaLabel = `${label ?? "Point cloud"}. ${spokenKeys(ELEMENT_KEYS)}.`;
  }

  /** Shows the progress. `null`: a cloud is being loaded, but the progress is not known. */
  showProgress(fraction: number | null): void {
    this.#bar.hidden = false;
    // Without its end, the bar moves.
    if (fraction === null && !isCalm()) this.#bar.removeAttribute("value");
    else this.#bar.value = fraction ?? 0;
  }

  hideProgress(): void {
    this.#bar.hidden = true;
  }

  /** Shows a sentence in the middle of the empty picture. */
  sayLoading(sentence: string | null): void {
    say(this.#loading, sentence);
  }

  sayError(sentence: string | null): void {
    say(this.#error, sentence);
  }

  /** Shows the page's own content of the element instead of the picture. Returns `false` if there is none. */
  showFallback(): boolean {
    const slot = this.#fallback.querySelector("slot")!;
    const filled = slot.assignedNodes().some((node) => node instanceof Element || node.textContent!.trim() !== "");
    this.#fallback.hidden = !filled;
    return filled;
  }
}

function make<Tag extends "canvas" | "progress" | "div">(tag: Tag, part: string): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  element.setAttribute("part", part);
  return element;
}

/** The element's own words, unless the page puts others into the slot of this name. */
function words(name: string): HTMLElement {
  const box = make("div", name);
  box.className = "words";
  const slot = document.createElement("slot");
  slot.name = name;
  box.append(slot);
  return box;
}

function say(box: HTMLElement, sentence: string | null): void {
  box.hidden = sentence === null;
  box.querySelector("slot")!.textContent = sentence;
}

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
