import type { LoadedCloud } from "../../cloud/cloud.ts";
import type { Reading } from "../blocks.ts";
import { CloudBuilder } from "../builder.ts";
import { CLASSES, CLASSIFICATION } from "./classes.ts";
import type { LasHeader } from "./header.ts";
import { lasPosition } from "../../../src/ts/formats/las.js";

const MOST_DECIMALS = 12;

const number = new Intl.NumberFormat("en-US");

/** Takes the points of a LAS file, one record after another. */
export class RecordTaker {
  readonly #header: LasHeader;
  readonly #builder: CloudBuilder;
  #outside = 0;

  constructor(header: LasHeader, reading: Pick<Reading, "limit" | "onPoints">, expected = header.count) {
    this.#header = header;
    this.#builder = new CloudBuilder("float64", header.columns, reading, expected);
  }

  take(view: DataView, at: number): void {
    if (!this.#builder.takes()) return;
    const { scale, low, high, columns } = this.#header;
    const [x, y, z] = lasPosition(this.#header, view, at);
    // The tolerance is one step of the scale, since the header's bounds are rounded, too.
    const isOutside = (value: number, axis: 0 | 1 | 2) =>
      value < low[axis] - scale[axis] || value > high[axis] + scale[axis];
    if (isOutside(x, 0) || isOutside(y, 1) || isOutside(z, 2)) this.#outside++;
    const i = this.#builder.put(x, y, z);
    for (let k = 0; k < columns.length; k++) this.#builder.values[k]![i] = columns[k]!.read(view, at);
  }

  finish(): LoadedCloud {
    const cloud = this.#builder.finish();
    const attributes = cloud.attributes!.map((attribute) =>
      attribute.name === CLASSIFICATION ? { ...attribute, labels: CLASSES } : attribute,
    );
    const fields = cloud.fields!.map((field) =>
      field.name === CLASSIFICATION ? { ...field, labels: CLASSES } : field,
    );
    const { scale, offset, crs, source } = this.#header;
    const facts = { ...cloud.facts, las: source, ...decimalsOf(scale, offset), ...(crs && { crs }) };
    const notes = [...cloud.notes!];
    if (this.#outside > 0) {
      notes.push(
        `${number.format(this.#outside)} of its points lie outside the bounds that its header gives: the header is wrong, or the points are damaged.`,
      );
    }
    return { ...cloud, attributes, fields, facts, notes };
  }
}

/** The decimals that every coordinate has: those of the scale and of the offset. */
function decimalsOf(
  scale: readonly number[],
  offset: readonly number[],
): { decimals: [number, number, number] } | Record<string, never> {
  const decimals = scale.map((step, axis) => Math.max(decimalsIn(step), decimalsIn(offset[axis]!)));
  // A scale such as 1/3 has no end. Then the coordinates are shown with all digits.
  return decimals.every((count) => count <= MOST_DECIMALS) ? { decimals: decimals as [number, number, number] } : {};
}

function decimalsIn(value: number): number {
  const [digits, exponent = "0"] = String(Math.abs(value)).split("e");
  return Math.max(0, (digits!.split(".")[1]?.length ?? 0) - Number(exponent));
}
