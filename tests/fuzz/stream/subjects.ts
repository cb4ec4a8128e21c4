// Two versions of an octree in each format, and what is visible in them.
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { type PotreeOctree, potreeOctree, town } from "../../package/octrees";
import { randomNumbers } from "../../package/support";
import { root } from "../../root";
import { type Naive, naiveCopc, naivePotree } from "./naive";
import type { Site } from "./server";

/** An octree in two versions: the same number of points, and often the same layout. */
export interface Subject {
  name: string;
  address: string;
  versions: readonly [Version, Version];
  viewpoints: readonly (readonly number[])[];
  /** The file that describes the others, and the bytes of it that a case may change. */
  damage: readonly { file: string; from: number; to: number }[];
  read: (site: Site) => Promise<Naive>;
}

export interface Version {
  site: Site;
  nodes: Naive;
}

const encoded = (value: unknown) => new Uint8Array(new TextEncoder().encode(JSON.stringify(value)));

const readPotree = (site: Site) =>
  Promise.resolve().then(() =>
    naivePotree({
      metadata: JSON.parse(new TextDecoder().decode(site["metadata.json"])) as PotreeOctree["metadata"],
      hierarchy: site["hierarchy.bin"]!,
      octree: site["octree.bin"]!,
    }),
  );

/** `isMoved`: whether the second version has the points of the first, moved within their nodes. Only `octree.bin` differs. */
async function potree(seed: number, points: number, isMoved: boolean): Promise<Subject> {
  const random = randomNumbers(seed);
  const build = () => potreeOctree(town(points, random, 20, 2), { leaf: 40, grid: 4 });
  const first = build();
  const second = isMoved ? { ...first, octree: moved(first) } : build();
  const versions = [first, second].map(async ({ metadata, hierarchy, octree }) => {
    const site = { "metadata.json": encoded(metadata), "hierarchy.bin": hierarchy, "octree.bin": octree };
    return { site, nodes: await readPotree(site) };
  });
  const both = (await Promise.all(versions)) as unknown as [Version, Version];
  const { site } = both[0];
  return {
    name: `Potree, ${points} points`,
    address: "https://example.org/town/metadata.json",
    versions: both,
    viewpoints: [
      [10.1, 9.9, 1.7],
      [0.5, 0.5, 1.7],
      [10, 10, 60],
      [-30, -40, 20],
      [5, 5, 3],
    ],
    damage: ["metadata.json", "hierarchy.bin"].map((file) => ({ file, from: 0, to: site[file]!.length })),
    read: readPotree,
  };
}

/** The same points, where each lies one step nearer to the middle of the points of its node. */
function moved({ octree, positions, nodes }: PotreeOctree): Uint8Array {
  const copy = octree.slice();
  const rows = new DataView(copy.buffer);
  const row = octree.length / (positions.length / 3);
  for (const { first, count, min, max } of nodes.values()) {
    for (let i = 3 * first; i < 3 * (first + count); i++) {
      const at = Math.floor(i / 3) * row + 4 * (i % 3);
      const middle = (min[i % 3]! + max[i % 3]!) / 2;
      rows.setInt32(at, rows.getInt32(at, true) + Math.sign(middle - positions[i]!), true);
    }
  }
  return copy;
}

/** The place of the first entry of the list of nodes in the fixture. */
const LISTED_FROM = 45_398 + 60;
/** Steps of a millimeter by which the second version lies elsewhere. */
const STEPS = 7;

async function copc(): Promise<Subject> {
  const name = "octree.copc.laz";
  const first = new Uint8Array(readFileSync(join(root, "tests/browser/fixtures", name)));
  const second = first.slice();
  const view = new DataView(second.buffer);
  // x of the box, and of the cube's center.
  for (const at of [179, 187, 429]) view.setFloat64(at, view.getFloat64(at, true) + 0.001 * STEPS, true);
  for (let at = LISTED_FROM; at + 32 <= second.length; at += 4) {
    const depth = view.getInt32(at, true);
    const [offset, length, points] = [Number(view.getBigUint64(at + 16, true)), view.getInt32(at + 24, true), view.getInt32(at + 28, true)]; // prettier-ignore
    const isEntry = depth >= 0 && depth < 4 && points > 0 && offset > 1000 && offset + length <= second.length;
    // The other points of a chunk are given by their differences.
    if (isEntry && length > 0) view.setInt32(offset, view.getInt32(offset, true) + STEPS, true);
  }
  const read = (site: Site) => naiveCopc(site[name]!);
  const versions = await Promise.all([first, second].map(async (bytes) => ({ site: { [name]: bytes }, nodes: await read({ [name]: bytes }) }))); // prettier-ignore
  return {
    name: "COPC, 3000 points",
    address: `https://example.org/${name}`,
    versions: versions as unknown as [Version, Version],
    viewpoints: [
      [512_345, 5_403_222.3, 431.6],
      [512_345.5, 5_403_210.3, 431.6],
      [512_350, 5_403_200, 440],
    ],
    damage: [
      { file: name, from: 0, to: 375 + 54 + 160 },
      { file: name, from: LISTED_FROM - 60, to: first.length },
    ],
    read,
  };
}

export async function subjects(): Promise<Subject[]> {
  return [await potree(1, 300, false), await potree(2, 600, true), await potree(3, 20, true), await copc()];
}
