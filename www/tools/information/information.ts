import type { Cloud } from "../../cloud/cloud.ts";
import type { Field } from "../../cloud/facts.ts";
import { byId } from "../../controls/dom.ts";
import { fieldText, measured, measuresOf, type Placed, shortest } from "../figures.ts";
import { row } from "../pick.ts";
import type { Bench } from "../tool.ts";

/** A category with more values than this is counted. With less, its values are named. */
const MOST_NAMED = 6;

const number = new Intl.NumberFormat("en-US");

/** What is known about the cloud: a section of the panel, filled while it is open. */
export class Information {
  readonly #bench: Bench;
  readonly #section = byId("info-section", HTMLDetailsElement);
  readonly #list = byId("info");
  /** The columns that are shown: another cloud, and other classes of points, have others. Of a streamed file, its name. */
  #shown: readonly Field[] | string | null = null;
  #upward = "";

  constructor(bench: Bench) {
    this.#bench = bench;
  }

  /** Called every frame. */
  follow(): void {
    const { viewer } = this.#bench;
    if (!viewer.cloud || !this.#section.open) return;
    const upward = this.#bench.upward().join();
    // Each view of a streamed file shows other points of it. The list stays as it was first shown.
    const shown = viewer.scene.answer.whole ? this.#bench.name() : viewer.cloud.fields;
    if (this.#shown === shown && this.#upward === upward) return;
    this.#shown = shown;
    this.#upward = upward;
    this.#list.replaceChildren(...this.#rows().map(([name, value]) => row(name, value)));
  }

  #rows(): [name: string, value: string][] {
    const { viewer, name } = this.#bench;
    const { scene } = viewer;
    const { cloud, answer } = scene;
    const { crs } = cloud.facts;
    const ends = endsOf(scene);
    return [
      ["File", name()],
      ["Points", pointsText(cloud, answer.whole?.total)],
      ...["x", "y", "z"].map((axis, i): [string, string] => [axis, `${ends[i]!.low} to ${ends[i]!.high}`]),
      ...(crs?.isAngular ? [] : this.#lengths()),
      ["Coordinates", crs?.name ?? "The file names no system"],
      ...cloud.fields.map((field): [string, string] => [field.name.replaceAll("_", " "), rangeText(field)]),
      ...(cloud.facts.dropped ? [["Not kept", `${cloud.facts.dropped} more columns`] as [string, string]] : []),
    ];
  }

  /** Rows with lengths. Degrees of longitude and latitude have none. */
  #lengths(): [name: string, value: string][] {
    const { scene } = this.#bench.viewer;
    const { cloud, inquiry, answer } = scene;
    const { unit, scale } = measuresOf(cloud);
    const isOneUnit = scale.every((length) => length === 1);
    const size = cloud.size.map((length, axis) => measured(length * scale[axis]!, null).split("\u00a0")[0]!);
    const rows: [string, string][] = [["Size", `${size.join(" × ")}\u00a0${unit?.name ?? "units"}`]];
    // Of an octree, only the coarser levels are here.
    if (answer.whole) return rows;
    const { spacing } = inquiry.cloud.points;
    if (spacing > 0 && isOneUnit) rows.push(["Spacing", measured(Number(spacing.toPrecision(3)), unit)]);
    return rows;
  }
}

function pointsText({ count, origin }: Cloud, whole: number | undefined): string {
  if (whole !== undefined) return `${number.format(whole)}, of which ${number.format(count)} are here`;
  return number.format(count) + (origin ? ", a part of the file" : "");
}

/** The least and the greatest coordinate of each axis, with the file's own digits. */
function endsOf({ cloud, positions }: Placed): { low: string; high: string }[] {
  return [0, 1, 2].map((axis) => {
    let [low, high] = [Infinity, -Infinity];
    for (let at = axis; at < positions.length; at += 3) {
      low = Math.min(low, positions[at]!);
      high = Math.max(high, positions[at]!);
    }
    const { decimals } = cloud.facts;
    const text = (value: number) => (decimals ? value.toFixed(decimals[axis]) : shortest(value, positions));
    return { low: text(low), high: text(high) };
  });
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
