import type { Unit } from "../../cloud/facts.ts";
import type { Viewer } from "../../view/viewer.ts";
import { measuresOf } from "../figures.ts";

const SVG = "http://www.w3.org/2000/svg";
/** The longest bar in CSS pixels, and its distance from the edge of the picture. */
const LONGEST = 120;
const EDGE = 20;
/** In narrower windows the tools are along the whole lower edge, so the bar is at the upper one, below its button. */
const NARROW = 760;
const BELOW_BUTTON = 84;

/** A bar of a round length in the picture, as things look at the distance of the place that the camera turns around. */
export class ScaleBar {
  readonly #viewer: Viewer;
  readonly #element = document.createElementNS(SVG, "g");
  readonly #lines = ["under", "over"].map((name) => {
    const line = document.createElementNS(SVG, "path");
    line.setAttribute("class", name);
    return line;
  });
  readonly #text = document.createElementNS(SVG, "text");
  #placed = "";

  constructor(svg: SVGSVGElement, viewer: Viewer) {
    this.#viewer = viewer;
    this.#element.setAttribute("class", "scale");
    this.#element.append(...this.#lines, this.#text);
    svg.prepend(this.#element);
  }

  /** Called every frame. Does nothing while nothing has moved. */
  place(): void {
    const { cloud, stage, navigation } = this.#viewer;
    const { camera, size } = stage;
    const distance = camera.position.distanceTo(navigation.target);
    const pixels = size.height / (2 * distance * Math.tan((camera.fov * Math.PI) / 360));
    const now = [pixels, size.width, size.height, cloud?.center].join();
    if (now === this.#placed) return;
    this.#placed = now;
    const measures = cloud && measuresOf(cloud);
    // A length without a unit says nothing.
    const isShown = measures?.unit && !cloud?.facts.crs?.isAngular && Number.isFinite(pixels);
    this.#element.style.display = isShown ? "" : "none";
    if (!isShown) return;

    const { unit, scale } = measures;
    const length = roundLength((LONGEST / pixels) * scale[0]);
    const width = (length * pixels) / scale[0];
    const right = size.width - EDGE;
    const bottom = innerWidth <= NARROW ? EDGE + BELOW_BUTTON : size.height - EDGE;
    for (const line of this.#lines) line.setAttribute("d", `M${right - width} ${bottom - 6}v6h${width}v-6`);
    this.#text.textContent = lengthText(length, unit);
    this.#text.setAttribute("x", String(right - width / 2));
    this.#text.setAttribute("y", String(bottom - 8));
  }
}

/** The greatest of 1, 2 or 5 times a power of ten that is not above the limit. */
export function roundLength(limit: number): number {
  const power = 10 ** Math.floor(Math.log10(limit));
  const times = [5, 2, 1].find((factor) => factor * power <= limit) ?? 1;
  return Number((times * power).toPrecision(1));
}

/** Meters are also written as kilometers, centimeters and millimeters. */
export function lengthText(length: number, unit: Unit | null): string {
  const metric = [
    { name: "km", meters: 1000 },
    { name: "m", meters: 1 },
    { name: "cm", meters: 0.01 },
    { name: "mm", meters: 0.001 },
  ];
  const shown = unit?.meters === 1 ? (metric.find(({ meters }) => length >= meters) ?? metric.at(-1)!) : null;
  const value = Number((length / (shown?.meters ?? 1)).toPrecision(1));
  const text =
    value >= 1e6 || value < 1e-4 ? String(value) : value.toLocaleString("en-US", { maximumFractionDigits: 6 });
  return `${text}\u00a0${shown?.name ?? unit?.name ?? (text === "1" ? "unit" : "units")}`;
}
