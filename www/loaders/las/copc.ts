import { HprError } from "../../../src/ts/base/errors.js";
import type { LoadedCloud, Streamed } from "../../cloud/cloud.ts";
import { displayScale } from "../../../src/ts/formats/colors.js";
import { Contradictions } from "../../../src/ts/formats/contradictions.js";
import { parseLasDetails } from "../../../src/ts/formats/las/details.js";
import { decodeChunk, type LazPerf } from "../../../src/ts/formats/las/laz-perf.js";
import { checkLazFormat, chunkParts, lazDamaged } from "../../../src/ts/formats/las/laz.js";
import { RecordTaker } from "../../../src/ts/formats/las/read-las.js";
import { openCopc } from "../../../src/ts/stream/copc.js";
import { type RangeReader, readPart } from "../../../src/ts/stream/source.js";
import type { OctreeNode } from "../../../src/ts/stream/tree.js";
import { LoadProblem } from "../problem.ts";
import { type Loading, loaded } from "../loaded.ts";
import { startLazPerf } from "./perf.ts";

const HEAD = 1 << 16;
/** The number of nodes that are requested ahead of the node being decompressed. */
const AHEAD = 6;

/** The most points that are shown of a streamed octree while the camera moves: soon read, and soon answered. */
const OVERVIEW = 1_000_000;
/** The most points that may be visible from one viewpoint of a streamed octree, with those that are being read. */
const BUDGET = 4_000_000;

const number = new Intl.NumberFormat("en-US");

/** Whether a LAS file is an octree. */
export async function isOctree(read: RangeReader): Promise<boolean> {
  return parseLasDetails(await read(0, HEAD)).isCopc;
}

/**
 * Reads a cloud-optimized point cloud: an octree in which deeper nodes hold finer samples. Levels are read from the
 * coarsest on, whole ones as long as the limit allows. So the shown points are spread evenly. If the first level alone
 * is beyond the limit, its points are thinned evenly. `from`: where the other levels are, if they are streamed later.
 */
export async function readCopc(
  reading: Omit<Loading, "blob">,
  read: RangeReader,
  from: string | Blob,
): Promise<LoadedCloud> {
  const { name, streamFrom = Infinity, onProgress } = reading;
  const header = parseLasDetails(await read(0, HEAD));
  checkLazFormat(header.format);
  if (header.count === 0) throw new LoadProblem(`${name} holds no points.`);
  const isStreamed = header.count > streamFrom;
  const limit = isStreamed ? Math.min(reading.limit, streamFrom, OVERVIEW) : reading.limit;
  const lazPerf = startLazPerf(name);
  const { nodes, points } = await chooseNodes(name, read, lazPerf, limit);
  const perf = await lazPerf;
  const found = new Contradictions(false);
  const taker = new RecordTaker(header, { ...reading, limit }, found, points);

  const asked: (Promise<Uint8Array> | undefined)[] = [];
  const ask = (i: number) => {
    const part = nodes[i] && readPart(name, read, nodes[i].part);
    // This error is reported later, when the node's turn comes.
    part?.catch(() => undefined);
    asked[i] = part;
  };
  for (let i = 0; i < AHEAD; i++) ask(i);
  for (const [i, { part, count }] of nodes.entries()) {
    onProgress?.(i / nodes.length);
    const compressed = await asked[i]!.catch(tell);
    asked[i] = undefined;
    ask(i + AHEAD);
    const { says } = chunkParts(compressed, count, header);
    if (says !== undefined) found.add(`the chunk at byte ${part.offset} ${says}`);
    try {
      decodeChunk(perf, compressed, count, header, (view, at) => {
        taker.take(view, at);
      });
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
  read: RangeReader,
  lazPerf: Promise<LazPerf>,
  limit: number,
): Promise<{ nodes: OctreeNode[]; points: number }> {
  const tree = await openCopc(name, read, { lazPerf, colors: false }).catch(tell);
  const nodes: OctreeNode[] = [];
  let points = 0;
  for (let level = [tree.root]; level.length > 0; level = level.flatMap(({ children }) => children)) {
    // A page of its own may list a node and those below it.
    for (const node of level) await tree.list(node).catch(tell);
    const more = level.reduce((sum, { count }) => sum + count, 0);
    if (points > 0 && points + more > limit) break;
    nodes.push(...level.filter(({ count }) => count > 0));
    points += more;
  }
  return { nodes, points };
}

/** Tells an error of the octree, whose message has the name of the file and the reason. */
function tell(error: unknown): never {
  if (!(error instanceof HprError)) throw error;
  throw error.cause instanceof LoadProblem ? error.cause : new LoadProblem(`${error.message}.`);
}
