// Reads whole octrees without the stream: every page, every node, one after another.
import type { Hierarchy } from "copc";
import type { PotreeOctree } from "../../package/octrees";

/** The points of a node, as the files place them. */
export interface NaiveNode {
  positions: number[];
  /** Whether each of them is in the node's cell and in the file's box. */
  isSound: boolean;
}

/** All nodes by their keys, or undefined if the files contradict themselves before. */
export type Naive = Map<string, NaiveNode>;

interface Frame {
  scale: number[];
  offset: number[];
  cube: [min: number[], max: number[]];
  bounds: [min: number[], max: number[]];
}

/** Reads the files of Potree 2. It throws where they cannot be read. */
export function naivePotree({ metadata, hierarchy, octree }: Pick<PotreeOctree, "metadata" | "hierarchy" | "octree">): Naive {
  type Attribute = { name: string; size: number; min?: number[]; max?: number[] };
  type Known = { scale: number[]; offset: number[]; attributes: Attribute[]; hierarchy: { firstChunkSize: number } };
  const { scale, offset, attributes, hierarchy: pages } = metadata as unknown as Known;
  const { min, max } = metadata["boundingBox"] as { min: number[]; max: number[] };
  const row = attributes.reduce((sum, { size }) => sum + size, 0);
  const at = attributes.slice(0, attributes.findIndex(({ name }) => name === "position"));
  const place = at.reduce((sum, { size }) => sum + size, 0);
  const own = attributes.find(({ name }) => name === "position")!;
  const frame: Frame = { scale, offset, cube: [min, max], bounds: [own.min ?? min, own.max ?? max] };
  const [entries, points] = [new DataView(hierarchy.buffer, hierarchy.byteOffset), new DataView(octree.buffer, octree.byteOffset)];
  const nodes: Naive = new Map();
  const list = (key: string, cell: number[], from: number, length: number): void => {
    const level = [{ key, cell }];
    for (let i = 0; i < length / 22; i++) {
      const { key, cell } = level[i]!;
      const entry = from + 22 * i;
      const [type, mask, count] = [entries.getUint8(entry), entries.getUint8(entry + 1), entries.getUint32(entry + 2, true)];
      const [start, bytes] = [6, 14].map((byte) => Number(entries.getBigInt64(entry + byte, true))) as [number, number];
      if (type === 2) {
        if (i === 0 || nodes.size > 1000) throw new Error("a page that does not list its node");
        list(key, cell, start, bytes);
        continue;
      }
      if (bytes !== count * row || start < 0 || start + bytes > octree.length) throw new Error("no such part");
      const integers = Array.from({ length: 3 * count }, (_, k) => points.getInt32(start + Math.floor(k / 3) * row + place + 4 * (k % 3), true));
      nodes.set(key, placed(integers, cell, key.length - 1, frame));
      for (let number = 0; number < 8; number++) {
        if ((mask >> number) & 1) level.push({ key: `${key}${number}`, cell: cell.map((c, axis) => 2 * c + ((number >> (2 - axis)) & 1)) });
      }
    }
    if (level.length * 22 !== length) throw new Error("a page of another length");
  };
  list("r", [0, 0, 0], 0, pages.firstChunkSize);
  return nodes;
} // prettier-ignore

/** Reads a COPC file by the functions of the package copc. It throws where it cannot be read. */
export async function naiveCopc(bytes: Uint8Array): Promise<Naive> {
  const { Copc } = await import("copc");
  const get = (from: number, to: number) => Promise.resolve(bytes.slice(from, to));
  const copc = await Copc.create(get);
  const { scale, offset, min, max } = copc.header;
  const frame: Frame = {
    scale,
    offset,
    cube: [copc.info.cube.slice(0, 3), copc.info.cube.slice(3)],
    bounds: [min, max],
  };
  const nodes: Naive = new Map();
  const listed: Hierarchy.Subtree = { nodes: {}, pages: {} };
  const pages = [copc.info.rootHierarchyPage];
  for (const page of pages) {
    if (pages.length > 100) throw new Error("too many pages");
    const own = await Copc.loadHierarchyPage(get, page);
    Object.assign(listed.nodes, own.nodes);
    for (const below of Object.values(own.pages)) if (below) pages.push(below);
  }
  for (const [key, node] of Object.entries(listed.nodes)) {
    const [depth, ...cell] = key.split("-").map(Number) as [number, number, number, number];
    const integers: number[] = [];
    if (node!.pointCount > 0) {
      const view = await Copc.loadPointDataView(get, copc, node!, { include: ["X", "Y", "Z"] });
      const getters = ["X", "Y", "Z"].map((name) => view.getter(name));
      for (let i = 0; i < view.pointCount; i++) {
        getters.forEach((getter, axis) => integers.push(Math.round((getter(i) - offset[axis]!) / scale[axis]!)));
      }
    }
    nodes.set(key, placed(integers, cell, depth, frame));
  }
  return nodes;
}

function placed(integers: number[], cell: number[], depth: number, { scale, offset, cube, bounds }: Frame): NaiveNode {
  const positions = integers.map((value, i) => value * scale[i % 3]! + offset[i % 3]!);
  const isSound = positions.every((value, i) => {
    const axis = i % 3;
    const width = (cube[1][axis]! - cube[0][axis]!) / 2 ** depth;
    const slack = Math.abs(scale[axis]!) + 1e-9 * Math.max(Math.abs(cube[0][axis]!), Math.abs(cube[1][axis]!));
    const low = Math.max(cube[0][axis]! + width * cell[axis]!, bounds[0][axis]!);
    const high = Math.min(cube[0][axis]! + width * (cell[axis]! + 1), bounds[1][axis]!);
    return value >= low - slack && value <= high + slack;
  });
  return { positions, isSound };
}
