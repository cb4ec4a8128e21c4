import type { Cloud, Field, Unit } from "../cloud/cloud.ts";
import type { Box } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import { fieldText, measured, measuresOf, shortest } from "./make.ts";
import { byId } from "../controls/controls.ts";
import { row } from "./pick.ts";
import type { Bench } from "./tool.ts";

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

/** A category with more values than this is counted. With less, its values are named. */
const MOST_NAMED = 6;

const number = new Intl.NumberFormat("en-US");

/** What is known about the cloud: a section of the panel, filled while it is open. */
export class Information {
  readonly #bench: Bench;
  readonly #section = byId("info-section", HTMLDetailsElement);
  readonly #list = byId("info");
  /** The columns that are shown: another cloud has others. */
  #shown: readonly Field[] | null = null;
  #upward = "";

  constructor(bench: Bench) {
    this.#bench = bench;
  }

  /** Called every frame. */
  follow(): void {
    const { viewer } = this.#bench;
    if (!viewer.cloud || !this.#section.open) return;
    const upward = this.#bench.upward().join();
    if (this.#shown === viewer.cloud.fields && this.#upward === upward) return;
    this.#shown = viewer.cloud.fields;
    this.#upward = upward;
    this.#list.replaceChildren(...this.#rows().map(([name, value]) => row(name, value)));
  }

  #rows(): [name: string, value: string][] {
    const { viewer, name } = this.#bench;
    const { scene } = viewer;
    const { cloud } = scene;
    const { crs } = cloud.facts;
    const { decimals } = cloud.facts;
    const text = (value: number, axis: number) =>
      decimals ? value.toFixed(decimals[axis]) : shortest(value, scene.positions);
    const [low, high] = endsOf(scene.positions);
    return [
      ["File", name()],
      ["Points", pointsText(cloud)],
      ...["x", "y", "z"].map((axis, i): [string, string] => [axis, `${text(low[i]!, i)} to ${text(high[i]!, i)}`]),
      ...(crs?.isAngular ? [] : this.#lengths()),
      ["Coordinates", crs?.name ?? "The file names no system"],
      ...cloud.fields.map((field): [string, string] => [field.name.replaceAll("_", " "), rangeText(field)]),
      ...(cloud.facts.dropped ? [["Not kept", `${cloud.facts.dropped} more columns`] as [string, string]] : []),
    ];
  }

  /** Rows with lengths. Degrees of longitude and latitude have none. */
  #lengths(): [name: string, value: string][] {
    const { scene } = this.#bench.viewer;
    const { cloud, inquiry } = scene;
    const { unit, scale } = measuresOf(cloud);
    const isOneUnit = scale.every((length) => length === 1);
    const size = cloud.size.map((length, axis) => measured(length * scale[axis]!, null).split("\u00a0")[0]!);
    const rows: [string, string][] = [["Size", `${size.join(" × ")}\u00a0${unit?.name ?? "units"}`]];
    const { spacing } = inquiry.cloud;
    if (spacing > 0 && isOneUnit) rows.push(["Spacing", measured(Number(spacing.toPrecision(3)), unit)]);
    return rows;
  }
}

function pointsText({ count, origin }: Cloud): string {
  return number.format(count) + (origin ? ", a part of the file" : "");
}

/** The corners of the box around positions. */
export function endsOf(positions: Float32Array | Float64Array): Box {
  const [low, high]: Box = [
    [Infinity, Infinity, Infinity],
    [-Infinity, -Infinity, -Infinity],
  ];
  for (let i = 0; i < positions.length; i++) {
    const [value, axis] = [positions[i]!, (i % 3) as 0 | 1 | 2];
    low[axis] = Math.min(low[axis], value);
    high[axis] = Math.max(high[axis], value);
  }
  return [low, high];
}

/** The meanings of a category, or the least and the greatest number. Numbers that are not finite do not count. */
function rangeText(field: Field): string {
  const { values, labels } = field;
  if (values.length === 1) return fieldText(field, 0);
  if (labels) {
    const found = [...new Set(values)].sort((a, b) => a - b);
    return found.length > MOST_NAMED
      ? `${found.length} different`
      : found.map((value) => labels[value] ?? String(value)).join(", ");
  }
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return low > high ? "no number" : `${shortest(low, values)} to ${shortest(high, values)}`;
}
