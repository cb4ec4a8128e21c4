import { CloudBuilder } from "./builder.js";
import type { CloudFile, Reading } from "./cloud-file.js";
import type { Column } from "./numbers.js";
import { type Accessor, GltfData, type GltfJson, type Numbers } from "./gltf-data.js";
import { FormatProblem } from "./problem.js";
import { step } from "./read-rows.js";
import { viewOf, wholeFile } from "./source.js";

interface Node {
  mesh?: number;
  children?: number[];
  matrix?: number[];
  translation?: number[];
  rotation?: number[];
  scale?: number[];
  extensions?: { EXT_mesh_gpu_instancing?: { attributes?: Record<string, number> } };
}

interface Scene extends GltfJson {
  asset?: { version?: string | number };
  scene?: number;
  scenes?: { nodes?: number[] }[];
  nodes?: (Node | null)[];
  meshes?: { primitives?: { attributes?: Record<string, number> }[] }[];
  extensionsRequired?: string[];
  extensionsUsed?: string[];
}

/** Extensions that a file may require: those that are read, and those that do not change where points are. */
const UNDERSTOOD =
  /^(KHR_(mesh_quantization|meshopt_compression|materials_|texture_|lights_|animation_|xmp)|EXT_(meshopt_compression|mesh_gpu_instancing|texture_))/;
/** Scenes place a mesh several times. More points than this for each byte of the file are a lie. */
const MOST_IN_A_BYTE = 100;
const CHANNELS = ["red", "green", "blue"];

/** The columns of a matrix, one after another. */
type Matrix = readonly number[];
const IDENTITY: Matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** Vertices, and where they are placed. */
interface Placed {
  attributes: Record<string, number>;
  count: number;
  matrix: Matrix;
}

/** The vertices of a glTF scene, of points and of meshes, placed by its nodes. */
export async function readGltf(reading: Reading): Promise<CloudFile> {
  const bytes = await wholeFile(reading.source);
  const { json, rest } = partsOf(bytes);
  checkUse(json);
  const data = await GltfData.open(json, rest, reading.beside);
  const placed = await verticesIn(json, data);
  const total = placed.reduce((sum, { count }) => sum + count, 0);
  if (total === 0) throw new FormatProblem("its scene has no vertices");
  if (total > MOST_IN_A_BYTE * (bytes.length + data.bytesBeside)) {
    throw new FormatProblem(`its scene promises ${total} points, more than ${MOST_IN_A_BYTE} for each of its bytes`);
  }
  const isColored = placed.some(({ attributes }) => "COLOR_0" in attributes);
  const own = ownColumns(placed, json.accessors ?? []);
  const columns: Column[] = [
    ...(isColored ? CHANNELS.map((name) => ({ name, type: "float32" }) as const) : []),
    ...own.map((name) => ({ name: name.slice(1).toLowerCase(), type: "float32" }) as const),
  ];
  const builder = new CloudBuilder("float64", columns, reading, total);
  for (const { attributes, count, matrix: m } of placed) {
    step(reading, (reading.source.size * builder.rows) / total);
    const positions = await data.numbers(attributes["POSITION"]!);
    const colors = attributes["COLOR_0"] === undefined ? undefined : await data.numbers(attributes["COLOR_0"]);
    const others = await Promise.all(
      own.map(async (name) => ((attributes[name] ?? -1) < 0 ? null : data.numbers(attributes[name]!))),
    );
    for (let i = 0; i < count; i++) {
      if (!builder.takes()) continue;
      const [x, y, z] = [0, 1, 2].map((axis) => positions.at(i, axis)) as [number, number, number];
      const along = (axis: 0 | 1 | 2) => m[axis]! * x + m[4 + axis]! * y + m[8 + axis]! * z + m[12 + axis]!;
      const row = builder.put(along(0), along(1), along(2));
      const first = isColored ? 3 : 0;
      for (let channel = 0; channel < first; channel++) {
        builder.values[channel]![row] = colors === undefined ? NaN : shown(colors.at(i, channel));
      }
      others.forEach(
        (values: Numbers | null, k) => (builder.values[first + k]![row] = values === null ? NaN : values.at(i, 0)),
      );
    }
  }
  return { ...builder.finish(), up: "y", unit: { name: "m", meters: 1 } };
}

/** The colors in a file are linear light. They are shown in bytes of sRGB. */
function shown(linear: number): number {
  const light = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
  return Math.round(255 * Math.min(1, Math.max(0, light)));
}

/** The description of the scene, and the binary part of a GLB file. */
function partsOf(data: Uint8Array<ArrayBuffer>): { json: Scene; rest: Uint8Array<ArrayBuffer> | undefined } {
  const view = viewOf(data);
  const isBinary = view.byteLength >= 20 && view.getUint32(0, true) === 0x46546c67;
  if (isBinary && view.getUint32(4, true) !== 2) throw new FormatProblem(tooOld(view.getUint32(4, true)));
  if (isBinary && view.getUint32(8, true) > view.byteLength) {
    throw new FormatProblem("it is shorter than its header says");
  }
  const end = isBinary ? 20 + view.getUint32(12, true) : data.length;
  let json: unknown;
  try {
    json = JSON.parse(new TextDecoder().decode(data.subarray(isBinary ? 20 : 0, end)));
  } catch (cause) {
    throw new FormatProblem("the description of its scene cannot be read", { cause });
  }
  if (typeof json !== "object" || json === null || Array.isArray(json)) {
    throw new FormatProblem("the description of its scene is no object");
  }
  const hasRest = isBinary && end + 8 <= data.length && view.getUint32(end + 4, true) === 0x004e4942;
  const rest = hasRest ? data.subarray(end + 8, Math.min(data.length, end + 8 + view.getUint32(end, true))) : undefined;
  return { json, rest };
}

function tooOld(version: unknown): string {
  return `its glTF version is ${String(version)}, and only version 2 is read; convert it to glTF 2.0`;
}

function checkUse({ asset, extensionsUsed = [], extensionsRequired = [] }: Scene): void {
  if (asset?.version === undefined) throw new FormatProblem("it does not give its glTF version");
  if (!/^2(\.|$)/.test(String(asset.version))) throw new FormatProblem(tooOld(asset.version));
  if ([...extensionsUsed, ...extensionsRequired].includes("KHR_draco_mesh_compression")) {
    throw new FormatProblem("it is compressed with Draco, which is not read; export it without that compression");
  }
  const unknown = extensionsRequired.find((extension) => !UNDERSTOOD.test(extension));
  if (unknown !== undefined) throw new FormatProblem(`it needs an extension that is not supported (${unknown})`);
}

async function verticesIn(
  { nodes = [], meshes = [], scenes = [], scene = 0 }: Scene,
  data: GltfData,
): Promise<Placed[]> {
  const placed: Placed[] = [];
  const visited = new Set<number>();
  const children = new Set(nodes.flatMap((node) => node?.children ?? []));
  const roots = scenes[scene]?.nodes ?? nodes.map((_, i) => i).filter((i) => !children.has(i));
  const open: [node: number, above: Matrix][] = roots.map((node): [number, Matrix] => [node, IDENTITY]).reverse();
  for (let next = open.pop(); next !== undefined; next = open.pop()) {
    const [at, above] = next;
    const node = nodes[at];
    if (!node || visited.has(at)) throw new FormatProblem(`its node ${at} is missing, or in two places`);
    visited.add(at);
    const matrix = product(above, matrixOf(node));
    for (const child of [...(node.children ?? [])].reverse()) open.push([child, matrix]);
    if (node.mesh === undefined) continue;
    const instances = await instancesOf(node, data);
    for (const { attributes = {} } of meshes[node.mesh]?.primitives ?? []) {
      if (attributes["POSITION"] === undefined) continue;
      const count = data.countOf(attributes);
      for (const instance of instances) placed.push({ attributes, count, matrix: product(matrix, instance) });
    }
  }
  return placed;
}

/** The places of a mesh in its node: one, or those of its instances. */
async function instancesOf({ extensions }: Node, data: GltfData): Promise<readonly Matrix[]> {
  const given = extensions?.EXT_mesh_gpu_instancing?.attributes;
  if (given === undefined) return [IDENTITY];
  const read = async (name: string) => (given[name] === undefined ? undefined : data.numbers(given[name]));
  const [translations, rotations, scales] = await Promise.all(["TRANSLATION", "ROTATION", "SCALE"].map(read));
  const count = Math.min(...[translations, rotations, scales].flatMap((each) => (each ? [each.count] : [])));
  const list = (numbers: Numbers | undefined, i: number, width: number) =>
    numbers && Array.from({ length: width }, (_, k) => numbers.at(i, k));
  return Array.from({ length: Number.isFinite(count) ? count : 1 }, (_, i) => {
    const [translation, rotation, scale] = [list(translations, i, 3), list(rotations, i, 4), list(scales, i, 3)];
    return matrixOf({ ...(translation && { translation }), ...(rotation && { rotation }), ...(scale && { scale }) });
  });
}

function matrixOf({ matrix, translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] }: Node): Matrix {
  const given = matrix ?? [...translation, ...rotation, ...scale];
  if (given.length !== (matrix ? 16 : 10) || !given.every((value) => Number.isFinite(value))) {
    throw new FormatProblem("the place of a node is not finite numbers");
  }
  if (matrix) return matrix;
  const [x, y, z, w] = rotation as [number, number, number, number];
  const [a, b, c] = scale as [number, number, number];
  return [
    a * (1 - 2 * (y * y + z * z)), a * 2 * (x * y + w * z), a * 2 * (x * z - w * y), 0,
    b * 2 * (x * y - w * z), b * (1 - 2 * (x * x + z * z)), b * 2 * (y * z + w * x), 0,
    c * 2 * (x * z + w * y), c * 2 * (y * z - w * x), c * (1 - 2 * (x * x + y * y)), 0,
    ...translation, 1,
  ]; // prettier-ignore
}

function product(a: Matrix, b: Matrix): Matrix {
  if (a === IDENTITY) return b;
  return b.map((_, i) => {
    const [row, column] = [i % 4, i - (i % 4)];
    return (
      a[row]! * b[column]! + a[4 + row]! * b[column + 1]! + a[8 + row]! * b[column + 2]! + a[12 + row]! * b[column + 3]!
    );
  });
}

/** The names of the file's own numbers, such as “_INTENSITY”. */
function ownColumns(placed: readonly Placed[], accessors: readonly Accessor[]): string[] {
  const names = new Set(placed.flatMap(({ attributes }) => Object.keys(attributes)));
  const isScalar = (name: string) =>
    placed.every(({ attributes }) => attributes[name] === undefined || accessors[attributes[name]]?.type === "SCALAR");
  return [...names].filter((name) => name.startsWith("_") && isScalar(name));
}
