import type { Cloud, Values } from "../cloud/cloud.ts";
import { type Field, valueAt } from "../cloud/facts.ts";
import { BATCH } from "./files.ts";

export interface PlyContent {
  positions: Float32Array | Float64Array;
  /** Three bytes for each point. */
  colors: Uint8Array | null;
  fields: readonly Field[];
  /** The points to be written. */
  indices: Uint32Array;
  comments: readonly string[];
}

type Setter = (view: DataView, at: number, value: number) => void;

interface Kind {
  type: string;
  bytes: number;
  set: Setter;
}

const KINDS = {
  int8: kind("char", 1, (view, at, value) => {
    view.setInt8(at, value);
  }),
  uint8: kind("uchar", 1, (view, at, value) => {
    view.setUint8(at, value);
  }),
  int16: kind("short", 2, (view, at, value) => {
    view.setInt16(at, value, true);
  }),
  uint16: kind("ushort", 2, (view, at, value) => {
    view.setUint16(at, value, true);
  }),
  int32: kind("int", 4, (view, at, value) => {
    view.setInt32(at, value, true);
  }),
  uint32: kind("uint", 4, (view, at, value) => {
    view.setUint32(at, value, true);
  }),
  float32: kind("float", 4, (view, at, value) => {
    view.setFloat32(at, value, true);
  }),
  float64: kind("double", 8, (view, at, value) => {
    view.setFloat64(at, value, true);
  }),
};

const KIND_OF = new Map<unknown, Kind>([
  [Int8Array, KINDS.int8],
  [Uint8Array, KINDS.uint8],
  [Uint8ClampedArray, KINDS.uint8],
  [Int16Array, KINDS.int16],
  [Uint16Array, KINDS.uint16],
  [Int32Array, KINDS.int32],
  [Uint32Array, KINDS.uint32],
  [Float32Array, KINDS.float32],
]);

const TAKEN = ["x", "y", "z", "red", "green", "blue"];

/** The columns of a cloud. Colors are written in bytes, as most programs expect them. */
export function plyFields({ colors, fields }: Cloud): Field[] {
  return fields.filter(({ name }) => !colors || !/^(red|green|blue)$/.test(name));
}

/** Yields a binary PLY file in pieces. Every number has the same type as in the cloud, so that nothing is lost. */
export function* plyParts({ positions, colors, fields, indices, comments }: PlyContent): Generator<BlobPart> {
  const columns: { name: string; kind: Kind; valueOf: (index: number) => number }[] = [];
  const add = (name: string, values: Values, valueOf: (index: number) => number) => {
    columns.push({ name, kind: KIND_OF.get(values.constructor) ?? KINDS.float64, valueOf });
  };
  for (const [axis, name] of ["x", "y", "z"].entries()) add(name, positions, (index) => positions[3 * index + axis]!);
  if (colors) {
    for (const [channel, name] of ["red", "green", "blue"].entries()) {
      add(name, colors, (index) => colors[3 * index + channel]!);
    }
  }
  for (const [name, values] of named(fields)) add(name, values, (index) => valueAt({ values }, index));

  const properties = columns.map(({ name, kind: { type } }) => `property ${type} ${name}`);
  yield [
    "ply",
    "format binary_little_endian 1.0",
    ...comments.map((text) => `comment ${text}`),
    `element vertex ${indices.length}`,
    ...properties,
    "end_header",
    "",
  ].join("\n");

  const stride = columns.reduce((sum, { kind: { bytes } }) => sum + bytes, 0);
  for (let from = 0; from < indices.length; from += BATCH) {
    const batch = indices.subarray(from, from + BATCH);
    const view = new DataView(new ArrayBuffer(stride * batch.length));
    let at = 0;
    for (const index of batch) {
      for (const {
        kind: { bytes, set },
        valueOf,
      } of columns) {
        set(view, at, valueOf(index));
        at += bytes;
      }
    }
    yield view;
  }
}

/** Gives each property a name that is one word. No two names are the same. */
function named(fields: readonly Field[]): [string, Field["values"]][] {
  const used = new Set(TAKEN);
  return fields.map(({ name, values }) => {
    const word = name.replace(/\W+/g, "_") || "scalar";
    let own = word;
    for (let i = 2; used.has(own); i++) own = `${word}_${i}`;
    used.add(own);
    return [own, values];
  });
}

function kind(type: string, bytes: number, set: Setter): Kind {
  return { type, bytes, set };
}
