import { type FilledColumn as Field, valueAt, type Values } from "../numbers.js";
import type { LasSource } from "../las/details.js";
import { type FieldPlace, layoutOf } from "../las/header.js";
import { BATCH, type Content } from "./content.js";

const HEAD = 375;
const RECORD_HEAD = 54;
const DESCRIPTION = 192;
const MOST_EXTRAS = Math.floor(65_535 / DESCRIPTION);
/** Formats whose points also have a place in a wave, which no reader of this page keeps. */
const WITHOUT_WAVES: Readonly<Record<number, number>> = { 4: 1, 5: 3, 9: 6, 10: 8 };
/** Coordinates are integers of 32 bits times the scale. */
const MOST_STEPS = 2 ** 31 - 1;
/** The code of each type of extra columns, in the LAS specification 1.4 R15, table 24. */
const EXTRA_CODES = new Map<unknown, number>([
  [Uint8Array, 1], [Int8Array, 2], [Uint16Array, 3], [Int16Array, 4], [Uint32Array, 5], [Int32Array, 6],
  [Float32Array, 9], [Float64Array, 10],
]); // prettier-ignore
const SIZES = [0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8];
/** Other names of the columns of LAS. */
const NAMES: Readonly<Record<string, string>> = {
  class: "classification", "gps time": "time", "point source id": "point source",
}; // prettier-ignore
const OWN_NAMES = new Set([3, 8].flatMap((format) => layoutOf(format)!.places.map(({ name }) => name)));

/** The name of an extra column has 32 bytes, the last of which stays zero. */
const LONGEST_NAME = 31;
/** How readers call what each point has. */
const STANDARD = [
  ...["x", "y", "z", "flagbyte", "bitfields", "synthetic", "keypoint", "withheld", "overlap", "scananglerank"],
  ...["scandirectionflag", "gpstime", "pointsourceid", "nir", "rawclassification", ...[...OWN_NAMES].map(bare)],
];

type Write = (view: DataView, at: number, index: number) => void;

interface Extra {
  write: Write;
  bytes: number;
  description: Uint8Array;
}

/**
 * Yields a LAS file in pieces. A cloud that came from LAS has its scale, offset, format, records and extra columns again;
 * its points are the same to the bit. Other clouds get version 1.4 and as fine a scale as fits, and columns without a
 * place in LAS become extra columns.
 */
export function* lasParts(
  { positions, colors, fields, indices }: Content,
  las?: LasSource,
): Generator<Uint8Array<ArrayBuffer>> {
  const format = las
    ? (WITHOUT_WAVES[las.format] ?? las.format)
    : colors || fields.some(({ name }) => name === "red")
      ? 7
      : 6;
  const layout = layoutOf(format)!;
  const { scale, offset } = las ?? finestScale({ positions, indices });
  const named = new Map(fields.map((field) => [nameOf(field.name), field]));
  const taken = new Set<string>();
  const writers = layout.places.flatMap((place): Write[] => {
    const field = named.get(place.name) ?? colorField(colors, place.name);
    if (!field || !fits(field.values, place)) return [];
    taken.add(place.name);
    return [writerOf(place, field)];
  });
  const left = withOwnNames([...named].filter(([name]) => !taken.has(name)).slice(0, MOST_EXTRAS));
  const extras = extrasOf(left, las);
  const rowBytes = layout.bytes + extras.reduce((sum, { bytes }) => sum + bytes, 0);

  const records = [...(las?.records ?? []), ...(extras.length > 0 ? [extraRecord(extras)] : [])];
  const counts = countsOf(fields, positions, indices, { scale, offset });
  yield headOf({ las, format, rowBytes, records, scale, offset, total: indices.length, ...counts });
  for (const record of records) yield record.slice();
  for (let from = 0; from < indices.length; from += BATCH) {
    const batch = indices.subarray(from, from + BATCH);
    const view = new DataView(new ArrayBuffer(rowBytes * batch.length));
    for (const [row, index] of batch.entries()) {
      const at = row * rowBytes;
      for (let axis = 0; axis < 3; axis++) {
        view.setInt32(at + 4 * axis, stepsOf(positions[3 * index + axis]!, scale[axis]!, offset[axis]!), true);
      }
      // A point without a number of returns is the first and only one.
      if (!taken.has("return number")) view.setUint8(at + 14, format >= 6 ? 0x11 : 0x09);
      for (const write of writers) write(view, at, index);
      let next = at + layout.bytes;
      for (const { write, bytes } of extras) {
        write(view, next, index);
        next += bytes;
      }
    }
    yield new Uint8Array(view.buffer);
  }
}

/** Readers take an extra column with the name of a standard one, or of another extra column, for a damaged file. */
function withOwnNames(columns: readonly (readonly [string, Field])[]): [string, Field][] {
  const used = new Set(STANDARD);
  return columns.map(([name, field]) => {
    let own = name.slice(0, LONGEST_NAME);
    for (let i = 2; used.has(bare(own)); i++) own = `${name.slice(0, LONGEST_NAME - 3)} ${i}`;
    used.add(bare(own));
    return [own, field];
  });
}

function bare(name: string): string {
  return name.toLowerCase().replaceAll(/[ _]/g, "");
}

function nameOf(name: string): string {
  const words = name.toLowerCase().replaceAll("_", " ");
  return NAMES[words] ?? (OWN_NAMES.has(words) ? words : name);
}

/** Colors in bytes fill 16 bits, so that white stays white. */
function colorField(colors: Content["colors"], name: string): Field | undefined {
  const channel = ["red", "green", "blue"].indexOf(name);
  if (!colors || channel < 0) return undefined;
  return { name, values: Uint16Array.from({ length: colors.length / 3 }, (_, i) => 257 * colors[3 * i + channel]!) };
}

/** Whether all numbers of a column fit its place in a point. */
function fits(values: Values, { type, bits }: FieldPlace): boolean {
  if (type === "float64") return true;
  const [low, high] = bits
    ? [0, 2 ** bits[1] - 1]
    : { uint8: [0, 255], int8: [-128, 127], uint16: [0, 65_535], int16: [-32_768, 32_767] }[type as "uint8"];
  for (const value of values) if (!(Number.isInteger(value) && value >= low! && value <= high!)) return false;
  return true;
}

function writerOf({ type, offset, bits }: FieldPlace, field: Field): Write {
  if (bits) {
    return (view, at, index) => {
      view.setUint8(at + offset, view.getUint8(at + offset) | (valueAt(field, index) << bits[0]));
    };
  }
  const set = setterOf(type);
  return (view, at, index) => {
    set(view, at + offset, valueAt(field, index));
  };
}

function setterOf(type: string): (view: DataView, at: number, value: number) => void {
  const name = `set${type[0]!.toUpperCase()}${type.slice(1)}` as "setUint16";
  return (view, at, value) => {
    view[name](at, value, true);
  };
}

/** Columns that LAS has no place for. A column that came from LAS keeps its description. */
function extrasOf(columns: readonly (readonly [string, Field])[], las: LasSource | undefined): Extra[] {
  return columns.map(([name, field]) => {
    const known = las?.extras.find((extra) => extra.name === name)?.description;
    return known ? describedExtra(field, known) : newExtra(name, field);
  });
}

function describedExtra(field: Field, description: Uint8Array): Extra {
  const view = new DataView(description.buffer, description.byteOffset);
  const [kind, options] = [view.getUint8(2), view.getUint8(3)];
  const scale = options & 8 ? view.getFloat64(112, true) : 1;
  const shift = options & 16 ? view.getFloat64(136, true) : 0;
  const isWhole = kind < 9;
  const write: Write = (row, at, index) => {
    const value = (valueAt(field, index) - shift) / scale;
    setKind(row, at, kind, isWhole ? Math.round(value) : value);
  };
  return { write, bytes: SIZES[kind]!, description };
}

function newExtra(name: string, field: Field): Extra {
  const kind = EXTRA_CODES.get(field.values.constructor) ?? 10;
  const description = new Uint8Array(DESCRIPTION);
  description[2] = kind;
  new TextEncoder().encodeInto(name, description.subarray(4, 35));
  const write: Write = (row, at, index) => {
    setKind(row, at, kind, valueAt(field, index));
  };
  return { write, bytes: SIZES[kind]!, description };
}

function setKind(view: DataView, at: number, kind: number, value: number): void {
  if (kind === 7) view.setBigUint64(at, BigInt(value), true);
  else if (kind === 8) view.setBigInt64(at, BigInt(value), true);
  else SETTERS[kind]!(view, at, value);
}

const SETTERS = [
  null, "uint8", "int8", "uint16", "int16", "uint32", "int32", null, null, "float32", "float64",
].map((type) => (type ? setterOf(type) : null)); // prettier-ignore

function extraRecord(extras: readonly Extra[]): Uint8Array<ArrayBuffer> {
  const record = new Uint8Array(RECORD_HEAD + DESCRIPTION * extras.length);
  record.set(new TextEncoder().encode("LASF_Spec"), 2);
  const view = new DataView(record.buffer);
  view.setUint16(18, 4, true);
  view.setUint16(20, DESCRIPTION * extras.length, true);
  for (const [i, { description }] of extras.entries()) record.set(description, RECORD_HEAD + DESCRIPTION * i);
  return record;
}

/** The finest scale with which these points fit, at most 10⁻⁹ of a unit. The offset is a whole number. */
export function finestScale({
  positions,
  indices,
}: Pick<Content, "positions" | "indices">): Pick<LasSource, "scale" | "offset"> {
  const ends = [0, 1, 2].map(() => [Infinity, -Infinity] as [low: number, high: number]);
  for (const i of indices) {
    ends.forEach((end, axis) => {
      end[0] = Math.min(end[0], positions[3 * i + axis]!);
      end[1] = Math.max(end[1], positions[3 * i + axis]!);
    });
  }
  // Without a point, it is 0.
  const offset = ends.map(([low, high]) => Math.floor(low / 2 + high / 2) || 0) as [number, number, number];
  const reach = Math.max(0, ...ends.map(([low, high]) => high - low)) / 2 + 1;
  const digits = Math.min(9, Math.floor(Math.log10(MOST_STEPS / reach)));
  // Written as a text, so that the scale is the number nearest to a power of ten.
  const step = Number(`1e${-digits}`);
  return { scale: [step, step, step], offset };
}

function stepsOf(value: number, scale: number, offset: number): number {
  return Math.round((value - offset) / scale);
}

interface Counts {
  low: number[];
  high: number[];
  /** How many points are the first, the second, … return. */
  returns: number[];
}

function countsOf(
  fields: readonly Field[],
  positions: Content["positions"],
  indices: Uint32Array,
  { scale, offset }: Pick<LasSource, "scale" | "offset">,
): Counts {
  const returnNumber = fields.find(({ name }) => nameOf(name) === "return number");
  const [low, high] = [
    [Infinity, Infinity, Infinity],
    [-Infinity, -Infinity, -Infinity],
  ] as [number[], number[]];
  const returns = Array.from({ length: 15 }, () => 0);
  for (const index of indices) {
    for (let axis = 0; axis < 3; axis++) {
      const steps = stepsOf(positions[3 * index + axis]!, scale[axis]!, offset[axis]!);
      const value = steps * scale[axis]! + offset[axis]!;
      low[axis] = Math.min(low[axis]!, value);
      high[axis] = Math.max(high[axis]!, value);
    }
    const nth = returnNumber ? valueAt(returnNumber, index) : 1;
    if (nth >= 1 && nth <= 15) returns[nth - 1]!++;
  }
  return { low, high, returns };
}

interface Head extends Counts, Pick<LasSource, "scale" | "offset"> {
  las: LasSource | undefined;
  format: number;
  rowBytes: number;
  records: readonly Uint8Array[];
  total: number;
}

function headOf({
  las,
  format,
  rowBytes,
  records,
  scale,
  offset,
  total,
  low,
  high,
  returns,
}: Head): Uint8Array<ArrayBuffer> {
  const minor = las ? Math.max(format >= 6 ? 4 : 2, las.head[25]!) : 4;
  const length = minor === 4 ? HEAD : minor === 3 ? 235 : 227;
  const bytes = new Uint8Array(length);
  // The identification, the date and the way in which times are counted stay.
  if (las) bytes.set(las.head.subarray(0, 104));
  const view = new DataView(bytes.buffer);
  bytes.set(new TextEncoder().encode("LASF"));
  // A coordinate system as WKT must be announced, and is not needed for other files.
  if (!las) view.setUint16(6, format >= 6 ? 16 : 0, true);
  bytes.set([1, minor], 24);
  bytes.fill(0, 58, 90);
  bytes.set(new TextEncoder().encode("hidden-point-removal"), 58);
  view.setUint16(94, length, true);
  view.setUint32(96, length + records.reduce((sum, record) => sum + record.length, 0), true);
  view.setUint32(100, records.length, true);
  view.setUint8(104, format);
  view.setUint16(105, rowBytes, true);
  if (format < 6) {
    view.setUint32(107, total, true);
    for (let i = 0; i < 5; i++) view.setUint32(111 + 4 * i, returns[i]!, true);
  }
  for (let axis = 0; axis < 3; axis++) {
    view.setFloat64(131 + 8 * axis, scale[axis]!, true);
    view.setFloat64(155 + 8 * axis, offset[axis]!, true);
    view.setFloat64(179 + 16 * axis, total > 0 ? high[axis]! : 0, true);
    view.setFloat64(187 + 16 * axis, total > 0 ? low[axis]! : 0, true);
  }
  if (minor === 4) {
    view.setBigUint64(247, BigInt(total), true);
    for (let i = 0; i < 15; i++) view.setBigUint64(255 + 8 * i, BigInt(returns[i]!), true);
  }
  return bytes;
}
