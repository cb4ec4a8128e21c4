import type { Viewpoint } from "../settings/settings.ts";
import { project } from "../view/viewer.ts";
import type { Viewer } from "../view/viewer.ts";
import { includes, Projection } from "./find.ts";

const SVG = "http://www.w3.org/2000/svg";

/** The distances of a text from its point, and from the edge of the picture. */
const ASIDE = 14;
const EDGE = 6;
/** The width that is kept free for an ellipsis. */
const DOTS = 14;

/** A mark over the picture, fastened to points of the cloud. */
export interface Mark {
  remove(): void;
}

interface Fastened {
  element: SVGGElement;
  anchors: readonly number[];
  /** Whether the mark is hidden while one of its anchors is hidden. Other marks are drawn faintly then. */
  hides: boolean;
  place: (ends: { x: number; y: number }[]) => void;
}

/** Marks over the picture. They move with their points, and show whether these are visible. */
export class Marks {
  readonly svg: SVGSVGElement;
  readonly #viewer: Viewer;
  readonly #all = new Set<Fastened>();
  readonly #pins = new Set<{ element: SVGGElement; at: Viewpoint }>();
  #placed = "";

  constructor(svg: SVGSVGElement, viewer: Viewer) {
    this.svg = svg;
    this.#viewer = viewer;
  }

  /** A ring around a point. */
  ring(index: number): Mark {
    const element = group("ring", [
      create("circle", { r: 9, class: "under" }),
      create("circle", { r: 9 }),
      create("circle", { r: 2, class: "dot" }),
    ]);
    return this.#fasten({
      element,
      anchors: [index],
      hides: false,
      place: ([at]) => move(element, at!),
    });
  }

  /** A line between two points with a text at its middle. */
  line(from: number, to: number, text: string): Mark {
    const lines = [create("line", { class: "under" }), create("line", {})];
    const label = withText(text);
    const dots = [create("circle", { r: 3, class: "dot" }), create("circle", { r: 3, class: "dot" })];
    const element = group("measure", [...lines, ...dots, label]);
    const place = ([a, b]: { x: number; y: number }[]) => {
      for (const line of lines) set(line, { x1: a!.x, y1: a!.y, x2: b!.x, y2: b!.y });
      for (const [i, dot] of dots.entries()) move(dot, [a!, b!][i]!);
      move(label, { x: (a!.x + b!.x) / 2, y: (a!.y + b!.y) / 2 - 10 });
    };
    return this.#fasten({ element, anchors: [from, to], hides: false, place });
  }

  /** A text beside a point, as long as the point is visible. */
  note(index: number, text: string): Mark {
    const label = new Fitted(text);
    const line = create("line", { y2: -11 });
    const element = group("note", [line, create("circle", { r: 3, class: "dot" }), label.element]);
    const place = ([at]: { x: number; y: number }[]) => {
      move(element, at!);
      const side = label.fit(at!.x, this.#viewer.stage.size.width);
      set(line, { x2: 11 * side });
    };
    return this.#fasten({ element, anchors: [index], hides: true, place });
  }

  /** A text at a place that need not have a point, such as a station. It is never covered. */
  pin(at: Viewpoint, text: string): Mark {
    const label = withText(text);
    set(label, { x: 10, y: -8 });
    const element = group("pin", [create("circle", { r: 5, class: "dot" }), label]);
    const pin = { element, at };
    this.svg.append(element);
    this.#pins.add(pin);
    this.invalidate();
    return {
      remove: () => {
        element.remove();
        this.#pins.delete(pin);
      },
    };
  }

  /** Moves the marks to their points. Called every frame; does nothing while nothing has moved. */
  place(): void {
    if (this.#all.size + this.#pins.size === 0 || !this.#viewer.cloud) return;
    const { camera, size } = this.#viewer.stage;
    const now = [camera.matrixWorld.elements, camera.projectionMatrix.elements, size.width, size.height].join();
    if (now === this.#placed) return;
    this.#placed = now;
    const { cloud, visible } = this.#viewer.scene;
    const at = new Projection(cloud.local, camera, size);
    for (const { element, anchors, hides, place } of this.#all) {
      const ends = anchors.map((index) => ({ inPicture: at.to(index), ahead: at.ahead, x: at.x, y: at.y }));
      const seen = anchors.every((index) => includes(visible, index));
      const shown = (seen || !hides) && ends.every(({ ahead }) => ahead > 0) && ends.some(({ inPicture }) => inPicture);
      element.style.display = shown ? "" : "none";
      element.classList.toggle("hidden", !seen);
      if (shown) place(ends);
    }
    for (const { element, at: place } of this.#pins) {
      const spot = project(this.#viewer, place);
      element.style.display = spot ? "" : "none";
      if (spot) move(element, spot);
    }
  }

  /** Called when other points are visible, or when there are other marks. */
  invalidate(): void {
    this.#placed = "";
    this.place();
  }

  #fasten(mark: Fastened): Mark {
    this.svg.append(mark.element);
    this.#all.add(mark);
    this.invalidate();
    return {
      remove: () => {
        mark.element.remove();
        this.#all.delete(mark);
      },
    };
  }
}

function create<Name extends keyof SVGElementTagNameMap>(
  name: Name,
  attributes: Record<string, string | number>,
): SVGElementTagNameMap[Name] {
  const element = document.createElementNS(SVG, name);
  set(element, attributes);
  return element;
}

function set(element: SVGElement, attributes: Record<string, string | number>): void {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
}

function group(kind: string, parts: SVGElement[]): SVGGElement {
  const element = create("g", { class: kind });
  element.append(...parts);
  return element;
}

function withText(text: string): SVGTextElement {
  const element = create("text", {});
  element.textContent = text;
  return element;
}

/** A text that is cut where the picture has too little room for it. */
class Fitted {
  readonly element: SVGTextElement;
  readonly #text: string;
  /** The length of each beginning of the text, by its number of letters. Measuring is slow, so it is done once. */
  #lengths: number[] | null = null;
  /** The number of letters that are shown. An ellipsis follows if there are more. */
  #kept: number;

  constructor(text: string) {
    this.element = withText(text);
    this.#text = text;
    this.#kept = text.length;
  }

  /** Puts the text to the right of a place (1). If there is too little room, but more on the left: to the left (-1). */
  fit(x: number, width: number): 1 | -1 {
    this.#lengths ??= this.#measured();
    const whole = this.#lengths.length - 1;
    const length = this.#lengths[whole]!;
    const [left, right] = [x - ASIDE - EDGE, width - x - ASIDE - EDGE];
    const side = length > right && left > right ? -1 : 1;
    const room = Math.max(left, right);
    let kept = whole;
    if (length > room) while (kept > 1 && this.#lengths[kept]! > room - DOTS) kept--;
    this.#show(kept);
    set(this.element, { "text-anchor": side > 0 ? "start" : "end" });
    move(this.element, { x: ASIDE * side, y: -ASIDE });
    return side;
  }

  #show(kept: number): void {
    if (kept === this.#kept) return;
    this.#kept = kept;
    const cut = kept < this.#text.length;
    this.element.textContent = cut ? `${this.#text.slice(0, kept).trimEnd()}…` : this.#text;
  }

  #measured(): number[] {
    return Array.from({ length: this.#text.length + 1 }, (_, kept) =>
      kept === 0 ? 0 : this.element.getSubStringLength(0, kept),
    );
  }
}

function move(element: SVGElement, { x, y }: { x: number; y: number }): void {
  element.setAttribute("transform", `translate(${x} ${y})`);
}
