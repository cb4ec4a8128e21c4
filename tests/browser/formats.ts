/*
 * LAS and glTF files, written by hand. The LAZ and COPC files among the fixtures hold the same points: see
 * fixtures/README.md.
 */
import { rows } from "./clouds.js";

const SCALE = 0.001;
const OFFSET = [512_000, 5_403_000, 400];

export interface LasOptions {
  minor?: number;
  format?: 0 | 1 | 2 | 3 | 6 | 7 | 8;
  /** A number of points for the header, instead of the true one. */
  claimed?: number;
  /** The name of one more float for each point, described as in the format. */
  extra?: string;
  /** Colors are bytes in 16 bits, like many programs write them. */
  smallColors?: boolean;
  /** The coordinate system, as text. */
  wkt?: string;
}

const RECORD = { 0: 20, 1: 28, 2: 26, 3: 34, 6: 30, 7: 36, 8: 38 };
const COLOR: Partial<Record<number, number>> = { 2: 20, 3: 28, 7: 30, 8: 30 };

/** Positions after reading them from a LAS file: whole millimeters, equal to the last bit. */
export function inMillimeters(positions: ArrayLike<number>): Float64Array {
  return Float64Array.from(
    positions,
    (value, i) => Math.round((value - OFFSET[i % 3]!) / SCALE) * SCALE + OFFSET[i % 3]!,
  );
}

/** The attributes of the n-th point. */
export const intensityOf = (i: number) => (i * 37) % 4096;
export const classOf = (i: number) => [2, 5, 6][i % 3]!;
export const colorOf = (i: number): [number, number, number] => [i % 256, (2 * i) % 256, 255 - (i % 256)];

export function las(
  positions: ArrayLike<number>,
  { minor = 2, format = 3, claimed, extra, smallColors = false, wkt }: LasOptions = {},
): Uint8Array {
  const points = rows(positions);
  const headerBytes = minor === 4 ? 375 : minor === 3 ? 235 : 227;
  const wktAt = headerBytes + (extra === undefined ? 0 : 54 + 192);
  const start = wktAt + (wkt === undefined ? 0 : 54 + wkt.length);
  const rowBytes = RECORD[format] + (extra === undefined ? 0 : 4);
  const bytes = new Uint8Array(start + rowBytes * points.length);
  const view = new DataView(bytes.buffer);
  bytes.set(new TextEncoder().encode("LASF"));
  view.setUint8(24, 1);
  view.setUint8(25, minor);
  view.setUint16(94, headerBytes, true);
  view.setUint32(96, start, true);
  view.setUint32(100, Number(extra !== undefined) + Number(wkt !== undefined), true);
  view.setUint8(104, format);
  view.setUint16(105, rowBytes, true);
  const count = claimed ?? points.length;
  view.setUint32(107, format < 6 ? Math.min(count, 2 ** 32 - 1) : 0, true);
  if (minor === 4) view.setBigUint64(247, BigInt(count), true);
  for (let axis = 0; axis < 3; axis++) {
    const values = points.map((point) => point[axis]!);
    view.setFloat64(131 + 8 * axis, SCALE, true);
    view.setFloat64(155 + 8 * axis, OFFSET[axis]!, true);
    view.setFloat64(179 + 16 * axis, Math.max(...values), true);
    view.setFloat64(187 + 16 * axis, Math.min(...values), true);
  }
  if (extra !== undefined) {
    bytes.set(new TextEncoder().encode("LASF_Spec"), headerBytes + 2);
    view.setUint16(headerBytes + 18, 4, true);
    view.setUint16(headerBytes + 20, 192, true);
    view.setUint8(headerBytes + 54 + 2, 9);
    bytes.set(new TextEncoder().encode(extra), headerBytes + 54 + 4);
  }
  if (wkt !== undefined) {
    bytes.set(new TextEncoder().encode("LASF_Projection"), wktAt + 2);
    view.setUint16(wktAt + 18, 2112, true);
    view.setUint16(wktAt + 20, wkt.length, true);
    bytes.set(new TextEncoder().encode(wkt), wktAt + 54);
  }
  points.forEach((point, i) => {
    const at = start + rowBytes * i;
    point.forEach((value, axis) => {
      view.setInt32(at + 4 * axis, Math.round((value - OFFSET[axis]!) / SCALE), true);
    });
    view.setUint16(at + 12, intensityOf(i), true);
    view.setUint8(at + 14, format < 6 ? 0b1001 : 0b10001);
    view.setUint8(at + (format < 6 ? 15 : 16), classOf(i));
    const color = COLOR[format];
    if (color !== undefined) {
      colorOf(i).forEach((value, k) => {
        view.setUint16(at + color + 2 * k, smallColors ? value : 257 * value, true);
      });
    }
    if (extra !== undefined) view.setFloat32(at + RECORD[format], i / 7, true);
  });
  return bytes;
}

export interface GlbOptions {
  /** 0: points, 4: triangles. */
  mode?: 0 | 4;
  colors?: boolean;
  required?: string[];
  /** Half of the points, placed twice by two nodes. */
  twice?: boolean;
}

/** A scene whose node moves its points by NODE_AT. Their own coordinates are small, so that they fit f32. */
export function glb(positions: ArrayLike<number>, options: GlbOptions = {}): Uint8Array {
  const { json, binary } = gltfParts(positions, options);
  const text = padded(
    new TextEncoder().encode(JSON.stringify({ ...json, buffers: [{ byteLength: binary.length }] })),
    0x20,
  );
  const header = Uint32Array.of(0x46546c67, 2, 12 + 8 + text.length + 8 + binary.length, text.length, 0x4e4f534a);
  return new Uint8Array(
    Buffer.concat([
      new Uint8Array(header.buffer),
      text,
      new Uint8Array(Uint32Array.of(binary.length, 0x004e4942).buffer),
      binary,
    ]),
  );
}

/** The scene of `glb` as text. Its numbers are inside, or at `uri`. */
export function gltf(positions: ArrayLike<number>, uri?: string): Uint8Array {
  const { json, binary } = gltfParts(positions, {});
  const buffer = {
    byteLength: binary.length,
    uri: uri ?? `data:application/octet-stream;base64,${Buffer.from(binary).toString("base64")}`,
  };
  return new TextEncoder().encode(JSON.stringify({ ...json, buffers: [buffer] }));
}

/** The binary part of the scene, as a file of its own. */
export function gltfBinary(positions: ArrayLike<number>): Uint8Array {
  return gltfParts(positions, {}).binary;
}

/** Where the node of `glb` puts the points. */
export const NODE_AT = [512_345, 5_403_210, 431] as const;

/** Positions after reading them from a glTF scene: f32 in the file, moved in f64. */
export function moved(positions: ArrayLike<number>): Float64Array {
  return Float64Array.from(positions, (value, i) => Math.fround(value) + NODE_AT[i % 3]!);
}

function gltfParts(
  positions: ArrayLike<number>,
  { mode = 0, colors = false, required = [], twice = false }: GlbOptions,
) {
  const count = positions.length / 3;
  const numbers = Float32Array.from(positions);
  const bytes = Uint8Array.from({ length: 4 * count }, (_, i) => (i % 4 === 3 ? 255 : colorOf(i >> 2)[i % 4]!));
  const binary = new Uint8Array(Buffer.concat([new Uint8Array(numbers.buffer), colors ? bytes : new Uint8Array()]));
  const range = (pick: (...values: number[]) => number) =>
    [0, 1, 2].map((axis) => pick(...numbers.filter((_, i) => i % 3 === axis)));
  const json = {
    asset: { version: "2.0" },
    extensionsUsed: required,
    extensionsRequired: required,
    scene: 0,
    scenes: [{ nodes: twice ? [0, 1] : [0] }],
    nodes: [
      { mesh: 0, translation: NODE_AT },
      { mesh: 0, translation: NODE_AT, scale: [2, 2, 2] },
    ].slice(0, twice ? 2 : 1),
    meshes: [{ primitives: [{ attributes: { POSITION: 0, ...(colors ? { COLOR_0: 1 } : {}) }, mode, material: 0 }] }],
    // An image that does not exist. The page must not request it.
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
    textures: [{ source: 0 }],
    images: [{ uri: "nowhere.png" }],
    accessors: [
      { bufferView: 0, componentType: 5126, count, type: "VEC3", min: range(Math.min), max: range(Math.max) },
      { bufferView: 1, componentType: 5121, normalized: true, count, type: "VEC4" },
    ].slice(0, colors ? 2 : 1),
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: 12 * count },
      { buffer: 0, byteOffset: 12 * count, byteLength: 4 * count },
    ].slice(0, colors ? 2 : 1),
  };
  return { json, binary };
}

function padded(bytes: Uint8Array, fill: number): Uint8Array {
  const result = new Uint8Array(4 * Math.ceil(bytes.length / 4)).fill(fill);
  result.set(bytes);
  return result;
}

/** The positions, and an intensity, a class and a color for each, as a text with a line of names. */
export function table(positions: ArrayLike<number>): Uint8Array {
  const lines = rows(positions).map((point, i) => [...point, intensityOf(i), classOf(i), ...colorOf(i)].join(","));
  return new TextEncoder().encode(`x,y,z,intensity,class,red,green,blue\n${lines.join("\n")}\n`);
}

/** The points of `table` as a PCD file. Its colors are four bytes that are declared as a float. */
export function attributedPcd(positions: ArrayLike<number>): Uint8Array {
  const count = positions.length / 3;
  const header = [
    "VERSION 0.7",
    "FIELDS x y z rgb intensity class",
    "SIZE 4 4 4 4 4 4",
    "TYPE F F F F F U",
    "COUNT 1 1 1 1 1 1",
    `WIDTH ${count}`,
    "HEIGHT 1",
    `POINTS ${count}`,
    "DATA binary",
    "",
  ].join("\n");
  const view = new DataView(new ArrayBuffer(24 * count));
  rows(positions).forEach((point, i) => {
    point.forEach((value, axis) => {
      view.setFloat32(24 * i + 4 * axis, value, true);
    });
    const [red, green, blue] = colorOf(i);
    // With 255 in the highest byte the float is not a number.
    view.setUint32(24 * i + 12, ((255 << 24) | (red << 16) | (green << 8) | blue) >>> 0, true);
    view.setFloat32(24 * i + 16, intensityOf(i), true);
    view.setUint32(24 * i + 20, classOf(i), true);
  });
  return new Uint8Array(Buffer.concat([new TextEncoder().encode(header), new Uint8Array(view.buffer)]));
}
