import { describe, HprError } from "../base/errors.js";
import { broken, type ByteRange, type PotreeFiles, type RangeReader, readRange } from "./source.js";
import { childCell, type NodePoints, type OctreeNode, Tree, type TreeFacts, type Triple } from "./tree.js";

/** The bytes of an entry of `hierarchy.bin`. */
const ENTRY = 22;
/** The type of an entry whose node is listed in another page. */
const LISTED_ELSEWHERE = 2;

/** How the points are stored in `octree.bin`. */
interface Rows {
  /** The number of bytes of a point. */
  length: number;
  /** The place of its position: three integers. */
  position: number;
  /** The place of red, green and blue. Undefined if there are none, or they are not wanted. */
  colors: number | undefined;
}

/**
 * Opens a Potree 2 octree (PotreeConverter 2), whose points are stored uncompressed.
 *
 * No library is used. The readers of Potree 2 (potree-core, three-loader) hand out geometries of
 * three.js in single precision and need the workers of browsers; loaders.gl reads Potree 1.
 */
export function openPotree(name: string, { metadata, hierarchy, octree }: PotreeFiles, wantsColors: boolean): Tree {
  const { facts, rows, first } = readMetadata(name, metadata);
  return new PotreeTree(facts, wantsColors ? rows : { ...rows, colors: undefined }, first, hierarchy, octree);
}

class PotreeTree extends Tree {
  readonly root: OctreeNode;
  readonly #rows: Rows;
  readonly #hierarchy: RangeReader;
  readonly #octree: RangeReader;

  constructor(facts: TreeFacts, rows: Rows, first: number, hierarchy: RangeReader, octree: RangeReader) {
    super(facts);
    this.#rows = rows;
    this.#hierarchy = hierarchy;
    this.#octree = octree;
    this.root = this.node("r", 0, [0, 0, 0]);
    this.defer(this.root, { offset: 0, length: first });
  }

  async read(node: OctreeNode, signal?: AbortSignal): Promise<NodePoints> {
    const bytes = await readRange(this.facts.name, this.#octree, node.part, signal);
    const { length, position, colors: colorsAt } = this.#rows;
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const integers = new Int32Array(3 * node.count);
    const colors = colorsAt === undefined ? undefined : new Uint16Array(3 * node.count);
    for (let i = 0; i < integers.length; i++) {
      const row = Math.floor(i / 3) * length;
      integers[i] = view.getInt32(row + position + 4 * (i % 3), true);
      if (colors) colors[i] = view.getUint16(row + colorsAt! + 2 * (i % 3), true);
    }
    return { positions: this.placed(node, integers), colors };
  }

  protected async readPage(top: OctreeNode, page: ByteRange): Promise<void> {
    const { name } = this.facts;
    const bytes = await readRange(name, this.#hierarchy, page);
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    // Each entry names the children of its node. They follow in this order, level by level.
    const nodes = [top];
    for (let i = 0; i < nodes.length; i++) {
      if (ENTRY * (i + 1) > bytes.length) {
        throw broken(name, `the page of node ${top.key} ends before node ${nodes[i]!.key}`);
      }
      nodes.push(...this.#readEntry(nodes[i]!, view, ENTRY * i, i === 0));
    }
    if (ENTRY * nodes.length !== bytes.length) {
      throw broken(name, `the page of node ${top.key} has ${bytes.length} bytes for ${nodes.length} nodes`);
    }
  }

  /** Returns the children that follow in the same page. */
  #readEntry(node: OctreeNode, view: DataView, at: number, isTop: boolean): OctreeNode[] {
    const { name } = this.facts;
    const type = view.getUint8(at);
    if (type > LISTED_ELSEWHERE) {
      throw broken(name, `node ${node.key} is listed with the unknown type ${type}`);
    }
    const mask = view.getUint8(at + 1);
    const count = view.getUint32(at + 2, true);
    const part = { offset: Number(view.getBigInt64(at + 6, true)), length: Number(view.getBigInt64(at + 14, true)) };
    if (type === LISTED_ELSEWHERE) {
      if (isTop) {
        throw broken(name, `the page of node ${node.key} does not list it`);
      }
      this.defer(node, part);
      return [];
    }
    if (part.length !== count * this.#rows.length) {
      throw broken(name, `node ${node.key} is listed with ${count} points, but has ${part.length} bytes`);
    }
    node.page = undefined;
    node.count = count;
    node.part = part;
    this.countListed(count);
    for (let number = 0; number < 8; number++) {
      if ((mask >> number) & 1) {
        // Potree's numbers have x as bit 2, and z as bit 0.
        const cell = childCell(node.cell, ((number & 1) << 2) | (number & 2) | (number >> 2));
        node.children.push(this.node(`${node.key}${number}`, node.depth + 1, cell));
      }
    }
    return node.children;
  }
}

interface Metadata {
  version: string;
  encoding: string;
  points: number;
  scale: Triple;
  offset: Triple;
  boundingBox: { min: Triple; max: Triple };
  hierarchy: { firstChunkSize: number };
  attributes: (Partial<Record<"name" | "type" | "size" | "min" | "max", unknown>> | null)[];
}

function readMetadata(name: string, given: unknown): { facts: TreeFacts; rows: Rows; first: number } {
  const unusable = (why: string) => new HprError("load", `${name} cannot be read: ${why}`);
  const metadata = (typeof given === "object" && given !== null ? given : {}) as Partial<Metadata>;
  const { version, encoding = "DEFAULT", points, scale, offset, boundingBox, hierarchy, attributes } = metadata;
  if (typeof version !== "string" || !version.startsWith("2.")) {
    throw unusable(`it must have the version 2 of Potree's metadata, got ${describe(version)}`);
  }
  if (encoding !== "DEFAULT") {
    throw unusable(`its points are compressed (${encoding}); convert it with PotreeConverter --encoding DEFAULT`);
  }
  const first = hierarchy?.firstChunkSize;
  const cube = { min: boundingBox?.min, max: boundingBox?.max };
  if (!(isTriple(scale) && isTriple(offset) && isTriple(cube.min) && isTriple(cube.max) && isCount(first))) {
    throw unusable("scale, offset, boundingBox or hierarchy is missing or has no numbers");
  }
  if (!isCount(points) || !Array.isArray(attributes)) {
    throw unusable("points or attributes is missing");
  }
  let length = 0;
  let position: number | undefined;
  let colors: number | undefined;
  let bounds: TreeFacts["bounds"];
  for (const attribute of attributes) {
    if (!isCount(attribute?.size)) {
      throw unusable(`its attribute ${describe(attribute?.name)} has no size`);
    }
    if (attribute.name === "position" && attribute.type === "int32" && attribute.size === 12) {
      const { min, max } = attribute;
      position = length;
      bounds = isTriple(min) && isTriple(max) ? { min, max } : undefined;
    }
    if (attribute.name === "rgb" && attribute.type === "uint16" && attribute.size === 6) {
      colors = length;
    }
    length += attribute.size;
  }
  if (position === undefined) {
    throw unusable("it has no attribute position of three int32");
  }
  const facts = { name, points, cube: { min: cube.min, max: cube.max }, bounds, scale, offset };
  return { facts, rows: { length, position, colors }, first };
}

function isCount(value: unknown): value is number {
  return Number.isSafeInteger(value) && (value as number) >= 0;
}

function isTriple(value: unknown): value is Triple {
  return Array.isArray(value) && value.length === 3 && value.every((number) => typeof number === "number");
}
