import { describe, HprError } from "../base/errors.js";
import { isNumberArray, plainNumbers } from "../base/typed-arrays.js";
import type { FilledColumn, Values } from "../formats/numbers.js";
import { contentOf, type WrittenFormat } from "../formats/write/content.js";
import { lasParts } from "../formats/write/las.js";
import { plyParts } from "../formats/write/ply.js";
import { givenOptions, listener, ownOf } from "../query/options.js";
import { isFloatArray } from "../query/positions.js";

/** Points to write, as `readCloud` gives them. */
export interface WritableCloud {
  /** x, y, z of one point after another. */
  positions: Float32Array | Float64Array;
  /** Red, green and blue of each point in bytes. */
  colors?: Uint8Array | Uint8ClampedArray | undefined;
  /** Other numbers of each point, by their names. */
  columns?: Readonly<Record<string, Values>> | undefined;
}

/** How a file is written. */
export interface WriteOptions {
  /** The points that are written, in this order. Default: all. */
  indices?: Uint32Array | undefined;
  /** Takes sentences about what the format changes, for example how an intensity is scaled. */
  onNote?: ((note: string) => void) | undefined;
}

/**
 * The bytes of a binary PLY file, or of a LAS file (version 1.4). Colors are bytes in PLY, and 16 bits in LAS; an intensity
 * that LAS cannot hold is scaled to 0 to 65535. Columns without a place in LAS become extra columns.
 *
 * @throws HprError `option` for another format, and for lengths that differ.
 */
export function writeCloud(
  cloud: WritableCloud,
  format: WrittenFormat,
  options: WriteOptions = {},
): Uint8Array<ArrayBuffer> {
  const given = givenOptions(options, ["indices", "onNote"]);
  const onNote = listener(given, "onNote") as WriteOptions["onNote"];
  const file = readCloudToWrite(cloud);
  const count = file.positions.length / 3;
  const indices = indicesIn(given["indices"], count);
  if (!["ply", "las"].includes(format)) {
    throw new HprError("option", `format must be "ply" or "las", got ${describe(format)}`);
  }
  const { content, notes } = contentOf(file, format, indices);
  for (const note of notes) onNote?.(note);
  const parts = [...(format === "las" ? lasParts(content) : plyParts(content))];
  const bytes = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  parts.reduce((at, part) => {
    bytes.set(part, at);
    return at + part.length;
  }, 0);
  return bytes;
}

function readCloudToWrite(cloud: unknown) {
  if (typeof cloud !== "object" || cloud === null) {
    throw new HprError("option", `the cloud must have positions, got ${describe(cloud)}`);
  }
  const [given, colors, columns = {}] = ["positions", "colors", "columns"].map((name) => ownOf(cloud, name));
  const positions = numbersIn(given);
  if (!isFloatArray(positions) || positions.length % 3 !== 0) {
    throw new HprError("option", `positions must be a Float32Array or Float64Array of x, y, z, got ${describe(given)}`);
  }
  if (typeof columns !== "object" || columns === null) {
    throw new HprError("option", `columns must be an object, got ${describe(columns)}`);
  }
  const count = positions.length / 3;
  const checked = (name: string, values: unknown, length: number) => {
    const numbers = numbersIn(values);
    if (numbers?.length === length) return numbers as Values;
    throw new HprError("option", `${name} must be a typed array of ${length} numbers, got ${describe(values)}`);
  };
  const fields: FilledColumn[] = Object.entries(columns).map(([name, values]) => ({
    name,
    values: checked(`columns.${name}`, values, count),
  }));
  const packed = colors === undefined ? undefined : checked("colors", colors, 3 * count);
  if (packed && !(packed instanceof Uint8Array || packed instanceof Uint8ClampedArray)) {
    throw new HprError(
      "option",
      `colors must be a Uint8Array of red, green and blue from 0 to 255, got ${describe(colors)}`,
    );
  }
  // Colors that the columns hold, too, are those of the columns, which may have more bits.
  return {
    positions: positions as Float64Array<ArrayBuffer>,
    columns: fields,
    ...(packed && { packed: Uint8Array.from(packed) }),
  };
}

/** The numbers of a typed array. Undefined for anything else, and if their memory is gone. */
function numbersIn(values: unknown) {
  return isNumberArray(values) ? plainNumbers(values) : undefined;
}

function indicesIn(given: unknown, count: number): Uint32Array {
  if (given === undefined) return Uint32Array.from({ length: count }, (_, i) => i);
  const indices = numbersIn(given);
  if (!(indices instanceof Uint32Array)) {
    throw new HprError("option", `indices must be a Uint32Array, got ${describe(given)}`);
  }
  const wrong = indices.find((index) => index >= count);
  if (wrong !== undefined) throw new HprError("option", `indices has ${wrong}, and the cloud has ${count} points`);
  return indices;
}
