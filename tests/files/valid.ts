// Small valid files.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

import { georeferencedBall } from "../browser/clouds";
import { glb, gltf, las } from "../browser/formats";

// The coordinates have the same value in single and double precision, and in every text.

export const POINTS = [
  [0, 0, 10],
  [1.5, -2, 0.25],
  [3, 4.125, -5],
  [-0.5, 7, 8],
] as const;
export const FLAT: readonly number[] = POINTS.flat();

/** A number in a binary file: its value, and the method of DataView that writes it. */
export type Value = readonly [value: number, kind: "Uint8" | "Int32" | "Uint16" | "Float32" | "Float64"];

export function binary(values: readonly Value[], littleEndian: boolean): Buffer {
  const parts = values.map(([value, kind]) => {
    const view = new DataView(new ArrayBuffer(Number(/\d+/.exec(kind)![0]) / 8));
    view[`set${kind}`](0, value, littleEndian);
    return Buffer.from(view.buffer);
  });
  return Buffer.concat(parts);
}

export const PLY_FORMATS = { ascii: "ascii", little: "binary_little_endian", big: "binary_big_endian" };

/** The header of a file with colored vertices and one face. */
export function plyHeader(encoding: keyof typeof PLY_FORMATS): string {
  return [
    "ply",
    `format ${PLY_FORMATS[encoding]} 1.0`,
    "comment by a test",
    "element vertex 4",
    "property float x",
    "property float y",
    "property float z",
    "property uchar red",
    "element face 1",
    "property list uchar int vertex_indices",
    "end_header",
    "",
  ].join("\n");
}

export function plyBody(encoding: keyof typeof PLY_FORMATS): Buffer {
  if (encoding === "ascii") {
    return Buffer.from(`${POINTS.map((point, i) => [...point, 10 * i].join(" ")).join("\n")}\n3 0 1 2\n`);
  }
  const vertices = POINTS.flatMap((point, i): Value[] => [
    ...point.map((value): Value => [value, "Float32"]),
    [10 * i, "Uint8"],
  ]);
  const face: Value[] = [[3, "Uint8"], ...[0, 1, 2].map((corner): Value => [corner, "Int32"])];
  return binary([...vertices, ...face], encoding === "little");
}

export type PcdEncoding = "ascii" | "binary" | "binary_compressed";

/** The header of a file with points that have an intensity. */
export function pcdHeader(encoding: PcdEncoding): string {
  return [
    "# .PCD v0.7",
    "VERSION 0.7",
    "FIELDS x y z intensity",
    "SIZE 4 4 4 1",
    "TYPE F F F U",
    "COUNT 1 1 1 1",
    "WIDTH 4",
    "HEIGHT 1",
    "VIEWPOINT 0 0 0 1 0 0 0",
    "POINTS 4",
    `DATA ${encoding}`,
    "",
  ].join("\n");
}

export function pcdBody(encoding: PcdEncoding): Buffer {
  if (encoding === "ascii") {
    return Buffer.from(`${POINTS.map((point, i) => [...point, 10 * i].join(" ")).join("\n")}\n`);
  }
  const rows = POINTS.map((point, i): Value[] => [
    ...point.map((value): Value => [value, "Float32"]),
    [10 * i, "Uint8"],
  ]);
  if (encoding === "binary") return binary(rows.flat(), true);
  const columns = binary(
    [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]!)),
    true,
  );
  return packed(literals(columns), columns.length);
}

/** Compressed data, after its compressed and its uncompressed length. */
export function packed(data: Uint8Array, unpacked: number, length = data.length): Buffer {
  const sizes = Buffer.alloc(8);
  sizes.writeUInt32LE(length, 0);
  sizes.writeUInt32LE(unpacked, 4);
  return Buffer.concat([sizes, data]);
}

/** LZF without compression: runs of up to 32 bytes. The length minus one comes before each run. */
export function literals(plain: Uint8Array): Buffer {
  const parts: Uint8Array[] = [];
  for (let at = 0; at < plain.length; at += 32) {
    const run = plain.subarray(at, at + 32);
    parts.push(Uint8Array.of(run.length - 1), run);
  }
  return Buffer.concat(parts);
}

/** The lines of a table. `separator` stands between the columns. */
export function table(separator: string, points: readonly (readonly (number | string)[])[] = POINTS): string {
  return points.map((point) => `${point.join(separator)}\n`).join("");
}

/** An array of NumPy. */
export function npy(type: string, shape: string, content: ArrayBufferView, order = "False"): Buffer {
  const head = `{'descr': ${type}, 'fortran_order': ${order}, 'shape': (${shape}), }\n`;
  const start = Buffer.from("\x93NUMPY\x01\x00..", "latin1");
  start.writeUInt16LE(head.length, 8);
  const { buffer, byteOffset, byteLength } = content;
  return Buffer.concat([start, Buffer.from(head), Buffer.from(buffer as ArrayBuffer, byteOffset, byteLength)]);
}

/** A file of each format, by its name. Those that are broken are refused. */
export function eachFormat(): Record<string, Uint8Array | string> {
  const fixture = (name: string) => readFileSync(join(import.meta.dirname, "../browser/fixtures", name));
  const floats = Float32Array.from(FLAT.slice(0, 12));
  const colmap = Buffer.alloc(8 + 51);
  colmap.writeBigUInt64LE(1n);
  return {
    "ball.laz": fixture("ball-14.laz"),
    "octree.copc.laz": fixture("octree.copc.laz"),
    "ball.las": las(georeferencedBall(9)),
    "two.e57": fixture("two-scans.e57"),
    "a.ply": Buffer.concat([Buffer.from(plyHeader("little")), plyBody("little")]),
    "a.pcd": Buffer.concat([Buffer.from(pcdHeader("binary_compressed")), pcdBody("binary_compressed")]),
    "a.csv": "x,y,z\n1,2,3\n",
    "a.csv.gz": gzipSync("x,y,z\n1,2,3\n"),
    "a.obj": "v 1 2 3\n",
    "a.ptx": "1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 0.5\n",
    "a.gltf": gltf(FLAT),
    "a.glb": glb(FLAT),
    "a.npy": npy("'<f4'", "4, 3", floats),
    "a.bin": new Uint8Array(floats.slice(0, 8).buffer),
    "points3D.bin": colmap,
    "broken.laz": fixture("ball-12.laz").subarray(0, 3000),
    "broken.gltf": '{"asset":{"version":"2.0"}}',
  };
}
