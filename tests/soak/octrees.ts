// A large octree, read node by node: how much of it a view needs, and whether the answer is that of the whole cloud.
import { init, PointCloud } from "hidden-point-removal";
import { type Octree, openOctree, type OctreeStep } from "hidden-point-removal/stream";

import { countedRanges, potreeOctree, type PotreeOctree, town } from "../package/octrees";
import { randomNumbers } from "../package/support";

const SEED = 7;
/** The width of the town, in meters, and its houses along one side. */
const [SIZE, HOUSES] = [400, 16];

/** One view of the octree. */
interface Row {
  viewpoint: string;
  /** Shares of all points, nodes and bytes. */
  visible: number;
  nodesHidden: number;
  bytesRead: number;
  /** How many bytes were read for the first step, as a share of all. */
  bytesFirst: number;
  steps: number;
  isEqual: boolean;
}

interface Measured {
  points: number;
  nodes: number;
  /** The estimated spacing by the whole cloud's. */
  spacing: number;
  rows: Row[];
}

/** What the command writes. */
interface Report {
  table: string;
  /** The viewpoints from which the octree answers otherwise than the town in one piece. */
  different: string[];
}

const VIEWPOINTS: [string, [number, number, number]][] = [
  ["on a street", [200.7, 151, 1.7]],
  ["inside a house", [211, 161, 1.7]],
  ["oblique, outside", [-120, -150, 90]],
  ["from above", [200, 200, 600]],
];

/** Streams a generated town from four viewpoints, and compares with the town in one piece. */
export async function report(points: number): Promise<Report> {
  const measured = await measure(points);
  const different = measured.rows.filter(({ isEqual }) => !isEqual).map(({ viewpoint }) => viewpoint);
  return { table: tableOf(measured), different };
}

async function measure(points: number): Promise<Measured> {
  await init();
  const files = potreeOctree(town(points, randomNumbers(SEED), SIZE, HOUSES), { leaf: 8000, grid: 48, step: 4 });
  const whole = new PointCloud(files.positions);
  const rows: Row[] = [];
  let spacing = 0;
  for (const [viewpoint, at] of VIEWPOINTS) {
    // Each view begins with an empty cache. The spacing is measured before, so that its bytes do not count.
    const octree = await opened(files);
    spacing = await octree.spacing();
    const c = 0.07 * spacing;
    octree.dispose();
    const steps = await stepsOf(await opened(files), at, c);
    const last = steps.at(-1)!;
    const expected = whole.visibleFrom(at, { inversion: { exponential: c } }).indices;
    const isEqual = last.exact && isSame(indicesOf(last, files), expected);
    rows.push({
      viewpoint,
      visible: last.count / points,
      nodesHidden: 1 - last.nodes.read / files.nodes.size,
      bytesRead: last.bytes / files.octree.length,
      bytesFirst: steps[0]!.bytes / files.octree.length,
      steps: steps.length,
      isEqual,
    });
  }
  return { points, nodes: files.nodes.size, spacing: spacing / whole.spacing, rows };
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

function isSame(a: Uint32Array, b: Uint32Array): boolean {
  return a.length === b.length && a.every((index, i) => index === b[i]);
}

function tableOf({ points, nodes, spacing, rows }: Measured): string {
  const percent = (share: number) => `${(100 * share).toFixed(1)} %`;
  const lines = rows.map((row) =>
    [
      row.viewpoint,
      percent(row.visible),
      percent(row.nodesHidden),
      percent(row.bytesRead),
      percent(row.bytesFirst),
      row.steps,
      row.isEqual ? "yes" : "NO",
    ].join(" | "),
  );
  return [
    `A town of ${points.toLocaleString("en")} points in ${nodes} nodes. The estimated spacing is ${spacing.toFixed(3)} times the whole cloud's.`,
    "",
    ...[
      "viewpoint | visible | nodes not fetched | bytes read | bytes at the first step | steps | equal to one piece",
      "---|---:|---:|---:|---:|---:|---",
      ...lines,
    ].map((line) => `| ${line} |`),
    "",
  ].join("\n");
}
