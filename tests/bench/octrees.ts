// A large octree, read node by node: how much of it a view needs, and whether the answer is that of the whole cloud.
import { PointCloud } from "hidden-point-removal";
import { type Octree, openOctree, type OctreeStep } from "hidden-point-removal/stream";

import { countedRanges, potreeOctree, type PotreeOctree, town } from "../package/octrees.js";
import { WrongAnswer } from "./check.js";
import { seeded } from "./generators.js";
import { digestOf } from "./measure.js";
import type { Row, Table } from "./report.js";

const POINTS = 2_000_000;
const SEED = 7;
/** The width of the town, in meters, and its houses along one side. */
const [SIZE, HOUSES] = [400, 16];

const VIEWPOINTS: [string, [number, number, number]][] = [
  ["on a street", [200.7, 151, 1.7]],
  ["inside a house", [211, 161, 1.7]],
  ["oblique, outside", [-120, -150, 90]],
  ["from above", [200, 200, 600]],
];

/** Streams a generated town from four viewpoints. Each answer must be that of the town in one piece. */
export async function readOctrees(): Promise<Table> {
  const files = potreeOctree(town(POINTS, seeded(SEED), SIZE, HOUSES), { leaf: 8000, grid: 48, step: 4 });
  const whole = new PointCloud(files.positions);
  const rows: Row[] = [];
  let spacing = 0;
  for (const [viewpoint, at] of VIEWPOINTS) {
    console.error(`town: ${viewpoint}…`);
    // Each view begins with an empty cache. The spacing is measured before, so that its bytes do not count.
    const octree = await opened(files);
    spacing = await octree.spacing();
    const c = 0.07 * spacing;
    octree.dispose();
    const steps = await stepsOf(await opened(files), at, c);
    const last = steps.at(-1)!;
    const expected = whole.visibleFrom(at, { inversion: { exponential: c } }).indices;
    if (!last.exact || digestOf(indicesOf(last, files)) !== digestOf(expected)) {
      throw new WrongAnswer(`${viewpoint}: the octree answers otherwise than the town in one piece`);
    }
    rows.push({
      viewpoint,
      "visible %": (100 * last.count) / POINTS,
      "nodes not fetched %": 100 * (1 - last.nodes.read / files.nodes.size),
      "bytes read %": (100 * last.bytes) / files.octree.length,
      "bytes at the first step %": (100 * steps[0]!.bytes) / files.octree.length,
      steps: steps.length,
    });
  }
  const note =
    `A town of ${POINTS.toLocaleString("en")} points in ${files.nodes.size} nodes. The estimated spacing is ${(spacing / whole.spacing).toFixed(3)} times the whole cloud's. ` +
    "All answers equal those of the cloud in one piece.";
  return { title: "Octrees", note, rows };
}

function opened({ metadata, hierarchy, octree }: PotreeOctree): Promise<Octree> {
  return openOctree({ metadata, hierarchy: countedRanges(hierarchy).read, octree: countedRanges(octree).read });
}

async function stepsOf(octree: Octree, viewpoint: readonly number[], c: number): Promise<OctreeStep[]> {
  const steps: OctreeStep[] = [];
  for await (const step of octree.visibleFrom(viewpoint, { inversion: { exponential: c } })) steps.push(step);
  return steps;
}

function indicesOf(step: OctreeStep, { nodes }: PotreeOctree): Uint32Array {
  const indices = new Uint32Array(step.count);
  let at = 0;
  for (const part of step.visible) {
    const { first } = nodes.get(part.key)!;
    for (const index of part.indices) indices[at++] = first + index;
  }
  return indices.sort();
}
