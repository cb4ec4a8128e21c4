import type { Copc, Hierarchy } from "copc";

import { asError, HprError } from "../base/errors.js";
import { crsOf } from "../formats/las/crs.js";
import { type ChunkLayout, LazDecoder } from "../formats/las/laz.js";
import type { CompileFiles } from "../formats/wasm.js";
import type { OctreeSettings } from "./options.js";
import { broken, type ByteRange, type RangeReader, readRange } from "./source.js";
import { childCell, type NodePoints, type OctreeNode, Tree, triple, type Triple } from "./tree.js";

/** The place of red, green and blue in a point of format 7 or 8. */
const COLORS_AT = 30;

/** The point formats of COPC, and their number of bytes. */
const FORMATS: Partial<Record<number, number>> = { 6: 30, 7: 36, 8: 38 };

function checkRecords(name: string, { format, rowBytes }: ChunkLayout): void {
  const least = FORMATS[format];
  if (least === undefined || rowBytes < least) {
    throw broken(name, `COPC has points of format 6, 7 or 8, but these have format ${format} and ${rowBytes} bytes`);
  }
}

function hasColors({ format }: ChunkLayout): boolean {
  return format > 6;
}

/** Decompresses one chunk of points: x, y, z as integers, and red, green and blue of each point if they are wanted. */
function decompress(
  name: string,
  key: string,
  chunk: Uint8Array,
  count: number,
  decoder: LazDecoder,
  isColored: boolean,
): { integers: Int32Array; colors: Uint16Array<ArrayBuffer> | undefined } {
  let integers = new Int32Array();
  let colors: Uint16Array<ArrayBuffer> | undefined;
  let at = 0;
  const says = decoder.decode(chunk, count, (point, from) => {
    if (at === 0) {
      // The decoder knows that the chunk may hold so many.
      integers = new Int32Array(3 * count);
      if (isColored) colors = new Uint16Array(3 * count);
    }
    for (let axis = 0; axis < 3; axis++, at++) {
      integers[at] = point.getInt32(from + 4 * axis, true);
      if (colors) colors[at] = point.getUint16(from + COLORS_AT + 2 * axis, true);
    }
  });
  if (says !== undefined) throw broken(name, `node ${key} ${says}`);
  return { integers, colors };
}

type Library = typeof import("copc");

/** Opens a cloud-optimized point cloud (copc.io): an octree in one LAZ file. */
export async function openCopc(name: string, read: RangeReader, { wasm, colors }: OctreeSettings): Promise<Tree> {
  const library = await loadLibrary();
  let copc: Copc;
  try {
    copc = await library.Copc.create(read);
  } catch (cause) {
    if (cause instanceof HprError) {
      throw cause;
    }
    throw new HprError("load", `${name} is not a COPC file, or it is broken: ${asError(cause).message}`, { cause });
  }
  return new CopcTree(name, read, library, copc, wasm, colors);
}

async function loadLibrary(): Promise<Library> {
  try {
    return await import("copc");
  } catch (cause) {
    throw new HprError("load", `COPC needs the package copc: npm install copc (${asError(cause).message})`, { cause });
  }
}

class CopcTree extends Tree {
  readonly root: OctreeNode;
  readonly #read: RangeReader;
  readonly #library: Library;
  readonly #wasm: CompileFiles;
  #decoder: LazDecoder | undefined;
  readonly #layout: ChunkLayout;
  /** Whether colors are read. */
  readonly #isColored: boolean;
  /** Entries of nodes that have a page of their own. */
  readonly #beside = new WeakMap<OctreeNode, Hierarchy.Node>();

  constructor(name: string, read: RangeReader, library: Library, copc: Copc, wasm: CompileFiles, wantsColors: boolean) {
    const { header, info } = copc;
    const corner = (numbers: readonly number[], from = 0) => triple((axis) => numbers[from + axis]!);
    super({
      name,
      points: header.pointCount,
      cube: { min: corner(info.cube), max: corner(info.cube, 3) },
      bounds: { min: corner(header.min), max: corner(header.max) },
      scale: corner(header.scale),
      offset: corner(header.offset),
      crs: crsOf(copc.wkt === undefined ? {} : { wkt: copc.wkt }) ?? undefined,
    });
    this.#layout = { format: header.pointDataRecordFormat, rowBytes: header.pointDataRecordLength };
    checkRecords(name, this.#layout);
    this.#isColored = wantsColors && hasColors(this.#layout);
    this.#read = read;
    this.#library = library;
    this.#wasm = wasm;
    this.root = this.node(keyOf(0, [0, 0, 0]), 0, [0, 0, 0]);
    this.defer(this.root, partOf(info.rootHierarchyPage));
  }

  async read(node: OctreeNode, signal?: AbortSignal): Promise<NodePoints> {
    const { name } = this.facts;
    const chunk = await readRange(name, this.#read, node.part, signal);
    const module = await this.#wasm();
    this.#decoder ??= new LazDecoder(module, this.#layout);
    const { integers, colors } = decompress(name, node.key, chunk, node.count, this.#decoder, this.#isColored);
    return { positions: this.placed(node, integers), colors };
  }

  protected async readPage(top: OctreeNode, page: ByteRange): Promise<void> {
    const { name } = this.facts;
    const bytes = await readRange(name, this.#read, page);
    let listed: Hierarchy.Subtree;
    try {
      const { offset: pageOffset, length: pageLength } = page;
      listed = await this.#library.Copc.loadHierarchyPage(() => Promise.resolve(bytes), { pageOffset, pageLength });
    } catch (cause) {
      throw broken(name, "its list of nodes cannot be read", cause);
    }
    // Some writers list such a node beside its page, and not in it.
    const own = listed.nodes[top.key] ?? this.#beside.get(top);
    if (own === undefined) {
      throw broken(name, `the page of node ${top.key} does not list it`);
    }
    const reached = new Set([top.key]);
    this.#add(top, own, listed, reached);
    if ([listed.nodes, listed.pages].some((entries) => Object.keys(entries).some((key) => !reached.has(key)))) {
      throw broken(name, `the page of node ${top.key} lists a node that is not below it`);
    }
  }

  /** Adds a node that a page lists, and those below it. */
  #add(node: OctreeNode, own: Hierarchy.Node, listed: Hierarchy.Subtree, reached: Set<string>): void {
    node.page = undefined;
    node.count = own.pointCount;
    node.part = { offset: own.pointDataOffset, length: own.pointDataLength };
    this.countListed(own.pointCount);
    for (let number = 0; number < 8; number++) {
      const cell = childCell(node.cell, number);
      const key = keyOf(node.depth + 1, cell);
      const [page, entry] = [listed.pages[key], listed.nodes[key]];
      if (page === undefined && entry === undefined) {
        continue;
      }
      reached.add(key);
      const child = this.node(key, node.depth + 1, cell);
      node.children.push(child);
      if (page !== undefined) {
        this.defer(child, partOf(page));
        if (entry !== undefined) this.#beside.set(child, entry);
      } else {
        this.#add(child, entry!, listed, reached);
      }
    }
  }
}

function keyOf(depth: number, cell: Triple): string {
  return [depth, ...cell].join("-");
}

function partOf({ pageOffset, pageLength }: Hierarchy.Page): ByteRange {
  return { offset: pageOffset, length: pageLength };
}
