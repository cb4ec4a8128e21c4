import { type FilledColumn, valueAt, type Values } from "../numbers.js";
import { BATCH, type Content } from "./content.js";

/** The types of PLY, and how their numbers are written. All other numbers are doubles. Open3D knows no "ushort". */
const TYPES = new Map<
  unknown,
  [type: string, write: "Int8" | "Uint8" | "Int16" | "Uint16" | "Int32" | "Uint32" | "Float32"]
>([
  [Int8Array, ["char", "Int8"]],
  [Uint8Array, ["uchar", "Uint8"]],
  [Uint8ClampedArray, ["uchar", "Uint8"]],
  [Int16Array, ["short", "Int16"]],
  [Uint16Array, ["uint16", "Uint16"]],
  [Int32Array, ["int", "Int32"]],
  [Uint32Array, ["uint", "Uint32"]],
  [Float32Array, ["float", "Float32"]],
]);

/** Yields a binary PLY file in pieces. Every number has the same type as in the cloud, so that nothing is lost. */
export function* plyParts(
  { positions, colors, fields, indices }: Content,
  comments: readonly string[] = [],
): Generator<Uint8Array<ArrayBuffer>> {
  const columns: { property: string; bytes: number; write: (view: DataView, at: number, index: number) => void }[] = [];
  const add = (name: string, values: Values | Uint8ClampedArray, valueOf: (index: number) => number) => {
    const [type, kind] = TYPES.get(values.constructor) ?? (["double", "Float64"] as const);
    columns.push({
      property: `property ${type} ${name}`,
      bytes: Number(/\d+/.exec(kind)![0]) / 8,
      write: (view, at, index) => {
        view[`set${kind}`](at, valueOf(index), true);
      },
    });
  };
  for (const [axis, name] of ["x", "y", "z"].entries()) add(name, positions, (index) => positions[3 * index + axis]!);
  if (colors) {
    for (const [channel, name] of ["red", "green", "blue"].entries()) {
      add(name, colors, (index) => colors[3 * index + channel]!);
    }
  }
  for (const [name, values] of named(fields, colors !== null)) add(name, values, (index) => valueAt({ values }, index));

  const head = [
    "ply",
    "format binary_little_endian 1.0",
    ...comments.map((text) => `comment ${text}`),
    `element vertex ${indices.length}`,
    ...columns.map(({ property }) => property),
    "end_header",
    "",
  ];
  yield new TextEncoder().encode(head.join("\n"));
  const stride = columns.reduce((sum, { bytes }) => sum + bytes, 0);
  for (let from = 0; from < indices.length; from += BATCH) {
    const batch = indices.subarray(from, from + BATCH);
    const view = new DataView(new ArrayBuffer(stride * batch.length));
    let at = 0;
    for (const index of batch) {
      for (const { bytes, write } of columns) {
        write(view, at, index);
        at += bytes;
      }
    }
    yield new Uint8Array(view.buffer);
  }
}

/** Gives each property a name that is one word. No two names are the same. */
function named(fields: readonly FilledColumn[], areColored: boolean): [string, Values][] {
  const used = new Set(["x", "y", "z", ...(areColored ? ["red", "green", "blue"] : [])]);
  return fields.map(({ name, values }) => {
    const word = name.replace(/\W+/g, "_") || "scalar";
    let own = word;
    for (let i = 2; used.has(own); i++) own = `${word}_${i}`;
    used.add(own);
    return [own, values];
  });
}
