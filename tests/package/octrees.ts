// Generated octrees in the format of Potree 2, as PotreeConverter 2 writes them without compression.

/** The files of an octree. */
export interface PotreeOctree {
  metadata: Record<string, unknown>;
  hierarchy: Uint8Array;
  octree: Uint8Array;
  /** x, y, z of all points as they come out of the files, node by node. */
  positions: Float64Array;
  /** The nodes, by their keys: where their points are among `positions`, and where in the file. */
  nodes: Map<string, { first: number; count: number; offset: number; length: number; min: number[]; max: number[] }>;
}

export interface PotreeChoices {
  scale?: number;
  /** A node with at most so many points has no children. */
  leaf?: number;
  /** A node keeps one point for each cell of a grid with so many cells along each axis. */
  grid?: number;
  /** The levels of nodes that one page lists. */
  step?: number;
  /** Red, green and blue for each of the points that are given. */
  colors?: Uint16Array;
}

interface Built {
  key: string;
  depth: number;
  points: Uint32Array;
  children: { number: number; node: Built }[];
}

/** Three integers, and one byte that nobody reads. Colors come after them. */
const [ROW, COLORS] = [13, 6];

/** Sorts points into an octree: each node keeps a sample of its points, and its children have the others. */
export function potreeOctree(given: ArrayLike<number>, choices: PotreeChoices = {}): PotreeOctree {
  const { scale = 0.001, leaf = 500, grid = 8, step = 2, colors } = choices;
  const row = colors ? ROW + COLORS : ROW;
  const count = given.length / 3;
  const offset = [0, 1, 2].map((axis) => least(given, axis));
  const integers = Int32Array.from(given, (value, i) => Math.round((value - offset[i % 3]!) / scale));
  const positions = Float64Array.from(integers, (value, i) => value * scale + offset[i % 3]!);
  const most = [0, 1, 2].map((axis) => -least(positions, axis, -1));
  const size = Math.max(...most.map((value, axis) => value - offset[axis]!)) || 1;

  const build = (key: string, depth: number, min: number[], points: Uint32Array): Built => {
    if (points.length <= leaf || depth > 12) return { key, depth, points, children: [] };
    const width = size / 2 ** depth;
    const taken = new Set<number>();
    const own: number[] = [];
    const rest: number[][] = Array.from({ length: 8 }, () => []);
    for (const i of points) {
      const cell = [0, 1, 2].map((axis) => {
        const at = Math.floor(((positions[3 * i + axis]! - min[axis]!) / width) * grid);
        return Math.min(Math.max(at, 0), grid - 1);
      }) as [number, number, number];
      const place = (cell[0] * grid + cell[1]) * grid + cell[2];
      if (!taken.has(place)) {
        taken.add(place);
        own.push(i);
      } else {
        const half = grid / 2;
        rest[(cell[0] >= half ? 4 : 0) + (cell[1] >= half ? 2 : 0) + (cell[2] >= half ? 1 : 0)]!.push(i);
      }
    }
    const children = rest.flatMap((part, number) => {
      if (part.length === 0) return [];
      const corner = min.map((value, axis) => value + ((number >> (2 - axis)) & 1 ? width / 2 : 0));
      return [{ number, node: build(`${key}${number}`, depth + 1, corner, Uint32Array.from(part)) }];
    });
    return { key, depth, points: Uint32Array.from(own), children };
  };
  const root = build(
    "r",
    0,
    offset,
    Uint32Array.from({ length: count }, (_, i) => i),
  );

  const octree = new Uint8Array(row * count);
  const rows = new DataView(octree.buffer);
  const placed = new Float64Array(3 * count);
  const nodes: PotreeOctree["nodes"] = new Map();
  let first = 0;
  const write = (node: Built) => {
    const min = [Infinity, Infinity, Infinity];
    const max = [-Infinity, -Infinity, -Infinity];
    nodes.set(node.key, {
      first,
      count: node.points.length,
      offset: row * first,
      length: row * node.points.length,
      min,
      max,
    });
    for (const i of node.points) {
      for (let axis = 0; axis < 3; axis++) {
        const value = positions[3 * i + axis]!;
        rows.setInt32(row * first + 4 * axis, integers[3 * i + axis]!, true);
        if (colors) rows.setUint16(row * first + ROW + 2 * axis, colors[3 * i + axis]!, true);
        placed[3 * first + axis] = value;
        min[axis] = Math.min(min[axis]!, value);
        max[axis] = Math.max(max[axis]!, value);
      }
      first += 1;
    }
    for (const child of node.children) write(child.node);
  };
  write(root);

  const { hierarchy, firstChunkSize } = pagesOf(root, nodes, step);
  const metadata = {
    version: "2.0", name: "generated", points: count, projection: "", encoding: "DEFAULT", spacing: size / grid,
    hierarchy: { firstChunkSize, stepSize: step, depth: 12 },
    offset, scale: [scale, scale, scale],
    boundingBox: { min: offset, max: offset.map((value) => value + size) },
    attributes: [
      { name: "position", size: 12, numElements: 3, elementSize: 4, type: "int32", min: offset, max: most },
      { name: "classification", size: 1, numElements: 1, elementSize: 1, type: "uint8", min: [0], max: [0] },
      ...(colors ? [{ name: "rgb", size: 6, numElements: 3, elementSize: 2, type: "uint16", min: [0], max: [65535] }] : []),
    ],
  }; // prettier-ignore
  return { metadata, hierarchy, octree, positions: placed, nodes };
}

/** The pages of the list of nodes: each lists some levels, and the next pages. The first page comes first. */
function pagesOf(root: Built, nodes: PotreeOctree["nodes"], step: number) {
  const pages: { top: Built; entries: Built[] }[] = [];
  const isOnPage = (node: Built, top: Built) => node === top || (node.depth - top.depth) % step !== 0;
  const collect = (top: Built) => {
    const entries = [top];
    for (const node of entries) {
      if (isOnPage(node, top)) entries.push(...node.children.map((child) => child.node));
    }
    pages.push({ top, entries });
    for (const node of entries) if (!isOnPage(node, top)) collect(node);
  };
  collect(root);
  const starts = new Map<Built, { at: number; length: number }>();
  let length = 0;
  for (const { top, entries } of pages) {
    starts.set(top, { at: length, length: 22 * entries.length });
    length += 22 * entries.length;
  }
  const hierarchy = new Uint8Array(length);
  const view = new DataView(hierarchy.buffer);
  let at = 0;
  for (const { top, entries } of pages) {
    for (const node of entries) {
      const { count, offset, length: bytes } = nodes.get(node.key)!;
      const elsewhere = isOnPage(node, top) ? undefined : starts.get(node)!;
      view.setUint8(at, elsewhere ? 2 : node.children.length === 0 ? 1 : 0);
      view.setUint8(
        at + 1,
        node.children.reduce((mask, { number }) => mask | (1 << number), 0),
      );
      view.setUint32(at + 2, count, true);
      view.setBigInt64(at + 6, BigInt(elsewhere?.at ?? offset), true);
      view.setBigInt64(at + 14, BigInt(elsewhere?.length ?? bytes), true);
      at += 22;
    }
  }
  return { hierarchy, firstChunkSize: starts.get(root)!.length };
}

/** The least coordinate along an axis, times the sign. */
function least(positions: ArrayLike<number>, axis: number, sign = 1): number {
  let value = Infinity;
  for (let i = axis; i < positions.length; i += 3) value = Math.min(value, sign * positions[i]!);
  return value;
}

/** Reads ranges of bytes, and notes each. */
export function countedRanges(bytes: Uint8Array): {
  read: (from: number, to: number) => Promise<Uint8Array>;
  asked: [number, number][];
} {
  const asked: [number, number][] = [];
  return {
    asked,
    read: (from, to) => {
      asked.push([from, to]);
      return Promise.resolve(bytes.subarray(from, to));
    },
  };
}

/** A town of boxes on a plane: walls and roofs hide much from the street. Points in the order of nothing. */
export function town(count: number, random: () => number, size = 100, houses = 8): Float64Array {
  const positions = new Float64Array(3 * count);
  const street = size / houses;
  for (let i = 0; i < count; i++) {
    const kind = random();
    const corner = [0, 1].map(() => Math.floor(random() * houses) * street) as [number, number];
    const height = 6 + 14 * Math.abs(Math.sin(corner[0] * 1.7 + corner[1] * 0.9));
    const [from, to] = [0.2 * street, 0.8 * street];
    const along = from + (to - from) * random();
    const across = from + (to - from) * random();
    const side = random() < 0.5 ? from : to;
    const rough = 0.01 * random();
    let point: number[];
    if (kind < 0.3) point = [size * random(), size * random(), rough];
    else if (kind < 0.5) point = [corner[0] + along, corner[1] + across, height + rough];
    else if (kind < 0.75) point = [corner[0] + along, corner[1] + side + rough, height * random()];
    else point = [corner[0] + side + rough, corner[1] + along, height * random()];
    positions.set(point, 3 * i);
  }
  return positions;
}

/** A room of 8 by 6 by 3 with tables and cupboards. */
export function room(count: number, random: () => number): Float64Array {
  const boxes = [
    [0, 0, 0, 8, 6, 3],
    ...Array.from({ length: 12 }, (_, i) => {
      const [x, y] = [0.5 + 1.9 * (i % 4), 0.6 + 1.9 * Math.floor(i / 4)];
      return [x, y, 0, x + 0.9, y + 0.7, i % 3 === 0 ? 2.1 : 0.8];
    }),
  ] as [number, number, number, number, number, number][];
  const positions = new Float64Array(3 * count);
  for (let i = 0; i < count; i++) {
    const box = random() < 0.5 ? boxes[0]! : boxes[1 + Math.floor(12 * random())]!;
    const flat = Math.floor(3 * random());
    for (let axis = 0; axis < 3; axis++) {
      const share = axis === flat ? Math.round(random()) : random();
      positions[3 * i + axis] = box[axis]! + (box[axis + 3]! - box[axis]!) * share;
    }
  }
  return positions;
}
