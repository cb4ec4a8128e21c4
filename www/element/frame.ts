import { ELEMENT_KEYS, spokenKeys } from "../controls/keys.ts";
import style from "./element.css?inline";

/** A new sentence must stay for this number of milliseconds before screen readers hear it. */
const SETTLED = 1000;

/** The element's shadow: the picture and the words over it, each with its slot and its part for the page. */
export class Frame {
  readonly #root: ShadowRoot;
  readonly #bar = make("progress", "progress");
  readonly #loading = words("loading");
  readonly #error = words("error");
  readonly #fallback = make("div", "fallback");
  readonly #live = make("p", "status");
  #canvas: HTMLCanvasElement | null = null;
  #label: string | null = null;
  #announcing: ReturnType<typeof setTimeout> | undefined;

  constructor(root: ShadowRoot) {
    this.#root = root;
    // A style element would need the permission of the page's security policy.
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(style);
    root.adoptedStyleSheets = [sheet];
    this.#bar.max = 1;
    this.#bar.ariaLabel = "Loading";
    this.#fallback.className = "fallback";
    this.#fallback.append(document.createElement("slot"));
    this.#live.className = "unseen";
    this.#live.role = "status";
    this.#bar.hidden = this.#loading.hidden = this.#error.hidden = this.#fallback.hidden = true;
    root.append(this.#bar, this.#loading, this.#error, this.#fallback, this.#live);
  }

  /** A new canvas each time: one that has been given up draws no more. */
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

  /** `null`: it is loading, but the progress is not known. */
  showProgress(fraction: number | null): void {
    this.#bar.hidden = false;
    if (fraction === null) this.#bar.removeAttribute("value");
    else this.#bar.value = fraction;
  }

  hideProgress(): void {
    this.#bar.hidden = true;
  }

  /** In the middle of the empty picture. */
  sayLoading(sentence: string | null): void {
    say(this.#loading, sentence);
  }

  sayError(sentence: string | null): void {
    say(this.#error, sentence);
  }

  /** Shows what the page has put into the element instead of the picture; `false` if it has put nothing there. */
  showFallback(): boolean {
    const slot = this.#fallback.querySelector("slot")!;
    const filled = slot.assignedNodes().some((node) => node instanceof Element || node.textContent!.trim() !== "");
    this.#fallback.hidden = !filled;
    return filled;
  }

  announce(sentence: string): void {
    clearTimeout(this.#announcing);
    this.#announcing = setTimeout(() => {
      this.#live.textContent = sentence;
    }, SETTLED);
  }

  /** Screen readers hear nothing more. */
  hush(): void {
    clearTimeout(this.#announcing);
    this.#live.textContent = "";
  }
}

function make<Tag extends "canvas" | "progress" | "div" | "p">(tag: Tag, part: string): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  element.setAttribute("part", part);
  return element;
}

/** Words of the element's own, unless the page has others for the slot of that name. */
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
