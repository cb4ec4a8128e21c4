import { Copc, type Hierarchy } from "copc";
import type { LoadedCloud, Streamed } from "../../cloud/cloud.ts";
import { displayScale } from "../../../src/ts/formats/colors.js";
import { Contradictions } from "../../../src/ts/formats/contradictions.js";
import { parseLasDetails } from "../../../src/ts/formats/las/details.js";
import { decodeChunk } from "../../../src/ts/formats/las/laz-perf.js";
import { checkLazFormat, chunkParts, lazDamaged } from "../../../src/ts/formats/las/laz.js";
import { RecordTaker } from "../../../src/ts/formats/las/read-las.js";
import { FormatProblem } from "../../../src/ts/formats/problem.js";
import { LoadProblem } from "../problem.ts";
import { type Loading, loaded } from "../loaded.ts";
import { startLazPerf } from "./perf.ts";

/** Reads bytes of the file, which may be on the device or on a server. */
export type ReadRange = (from: number, to: number) => Promise<Uint8Array>;

type Node = Hierarchy.Node;

const HEAD = 1 << 16;
const DEEPEST = 40;
const LARGEST_PART = 1 << 28;
/** The number of nodes that are requested ahead of the node being decompressed. */
const AHEAD = 6;

/** The most points that are shown of a streamed octree while the camera moves: soon read, and soon answered. */
const OVERVIEW = 1_000_000;
/** The most points that may be visible from one viewpoint of a streamed octree, with those that are being read. */
const BUDGET = 4_000_000;

const number = new Intl.NumberFormat("en-US");

/** Whether a LAS file is an octree. */
export async function isOctree(read: ReadRange): Promise<boolean> {
  return parseLasDetails(await read(0, HEAD)).isCopc;
}

/**
 * Reads a cloud-optimized point cloud: an octree in which deeper nodes hold finer samples. Levels are read from the
 * coarsest on, whole ones as long as the limit allows. So the shown points are spread evenly. If the first level alone
 * is beyond the limit, its points are thinned evenly. `from`: where the other levels are, if they are streamed later.
 */
export async function readCopc(
  reading: Omit<Loading, "blob">,
  read: ReadRange,
  from: string | Blob,
): Promise<LoadedCloud> {
  const { name, streamFrom = Infinity, onProgress } = reading;
  const header = parseLasDetails(await read(0, HEAD));
  checkLazFormat(header.format);
  if (header.count === 0) throw new LoadProblem(`${name} holds no points.`);
  const isStreamed = header.count > streamFrom;
  const limit = isStreamed ? Math.min(reading.limit, streamFrom, OVERVIEW) : reading.limit;
  const { nodes, points } = await chooseNodes(name, read, limit, header.count);
  const perf = await startLazPerf(name);
  const found = new Contradictions(false);
  const taker = new RecordTaker(header, { ...reading, limit }, found, points);

  const asked: Promise<Uint8Array>[] = [];
  const ask = (i: number) => {
    const node = nodes[i];
    if (!node) return;
    const part = read(node.pointDataOffset, node.pointDataOffset + node.pointDataLength);
    // This error is reported later, when the node's turn comes.
    part.catch(() => undefined);
    asked.push(part);
  };
  for (let i = 0; i < AHEAD; i++) ask(i);
  for (const [i, node] of nodes.entries()) {
    onProgress?.(i / nodes.length);
    const compressed = await asked[i]!;
    asked[i] = Promise.resolve(compressed.subarray(0, 0));
    ask(i + AHEAD);
    if (compressed.length < node.pointDataLength) {
      throw new LoadProblem(`${name} is broken: it ends before its points do.`);
    }
    const { says } = chunkParts(compressed, node.pointCount, header);
    if (says !== undefined) found.add(`the chunk at byte ${node.pointDataOffset} ${says}`);
    try {
      decodeChunk(perf, compressed, node.pointCount, header, (view, at) => taker.take(view, at));
    } catch {
      throw lazDamaged();
    }
  }
  const cloud = loaded(name, taker.finish(points === header.count));
  if (points >= header.count) return cloud;
  const shown = number.format(cloud.positions.length / 3);
  if (isStreamed) {
    return {
      ...cloud,
      ...streamedFrom(
        {
          from,
          name,
          points: header.count,
          budget: Math.min(reading.limit, BUDGET),
          colorScale: cloud.colors && scaleOfColors(cloud),
        },
        shown,
      ),
    };
  }
  return {
    ...cloud,
    notes: [
      `${shown} of its ${number.format(header.count)} points are shown: the points of its coarser levels.`,
      ...cloud.notes!.slice(points > limit ? 1 : 0),
    ],
  };
}

/** The overview and the other levels have the same factor, even if some points have dark colors alone. */
function scaleOfColors({ fields = [] }: LoadedCloud): number {
  return displayScale(fields.filter(({ name }) => /^(red|green|blue)$/.test(name)).map(({ values }) => values));
}

/** What is known of points that are the overview of an octree. The stream reads coordinates and colors, so they have no more. */
function streamedFrom(streamed: Streamed, shown: string): Partial<LoadedCloud> {
  return {
    attributes: [],
    fields: [],
    streamed,
    notes: [
      `Its ${number.format(streamed.points)} points are read as they are needed. While the camera moves, ${shown} points of its coarser levels are shown. When it rests, all that is visible is read, without attributes.`,
    ],
  };
}

/** The nodes of the coarsest levels, up to the limit. */
async function chooseNodes(
  name: string,
  read: ReadRange,
  limit: number,
  total: number,
): Promise<{ nodes: Node[]; points: number }> {
  const chosen: Node[] = [];
  let points = 0;
  try {
    const { info } = await Copc.create(read);
    const levels: Node[][] = [];
    const pages = [{ depth: 0, page: info.rootHierarchyPage }];
    const known = new Set<number>();
    for (let depth = 0; depth < DEEPEST; depth++) {
      // The nodes below a level may be listed in separate pages.
      for (let i = 0; i < pages.length; i++) {
        const { depth: from, page } = pages[i]!;
        if (from > depth) continue;
        pages.splice(i--, 1);
        if (!isPart(page.pageOffset, page.pageLength) || known.has(page.pageOffset)) throw lazDamaged();
        known.add(page.pageOffset);
        const listed = await Copc.loadHierarchyPage(read, page);
        for (const [key, node] of Object.entries(listed.nodes)) {
          if (node && node.pointCount > 0) (levels[depthOf(key)] ??= []).push(node);
        }
        for (const [key, next] of Object.entries(listed.pages)) {
          if (next) pages.push({ depth: Math.max(depthOf(key), depth), page: next });
        }
      }
      const level = levels[depth] ?? [];
      if (level.length === 0 && pages.length === 0 && levels.length <= depth + 1) break;
      const more = level.reduce((sum, node) => sum + node.pointCount, 0);
      if (points + more > total) throw lazDamaged();
      if (chosen.length > 0 && points + more > limit) break;
      chosen.push(...level);
      points += more;
    }
  } catch (error) {
    if (error instanceof LoadProblem || error instanceof FormatProblem) throw error;
    throw new LoadProblem(`${name} is broken: the list of its octree's nodes cannot be read.`);
  }
  if (chosen.length === 0) throw new LoadProblem(`${name} holds no points.`);
  if (!chosen.every((node) => isPart(node.pointDataOffset, node.pointDataLength))) throw lazDamaged();
  return { nodes: chosen, points };
}

function depthOf(key: string): number {
  return Number(key.split("-")[0]);
}

function isPart(offset: number, length: number): boolean {
  return offset > 0 && length > 0 && length <= LARGEST_PART;
}
