// Hulls of other libraries on the same flipped points, with the same radius.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

import type { Cloud } from "./clouds.js";
import { flip } from "./flip.js";
import type { Point } from "./measure.js";
import { ask, program, root, scratch, writeCloud } from "./paths.js";
import { withScipy } from "./python.js";

/** One answer of the library, to compare the peers with. */
export interface View {
  cloud: Cloud;
  exponent: number;
  viewpoint: Point;
  radius: number;
  indices: Uint32Array;
}

export interface PeerResult {
  peer: string;
  /** Milliseconds of each run; undefined if the first run was stopped. */
  milliseconds: number[] | undefined;
  /** The number of points whose label differs from the library's answer. */
  differing: number;
}

export interface Peer {
  name: string;
  version: string;
  takes: (cloud: Cloud) => boolean;
  /** Writes the hull's vertices to `out`. Returns the milliseconds as JSON, or undefined if it was stopped. */
  run(view: View, out: string): string | undefined;
}

/** A peer that has not finished after this time is stopped. */
export const PEER_LIMIT_MS = 120_000;
/** From this number of points on, one run of SciPy is enough. */
const LARGE = 500_000;

/** The hull of three.js, and with `python` also SciPy's. */
export function peers(python: boolean): Peer[] {
  return [three, ...(python ? scipy() : [])];
}

/** Runs a peer on a view and counts the labels that differ from the library's. */
export function compareWithPeer(peer: Peer, view: View): PeerResult {
  const out = scratch("vertices.u32");
  const { name } = peer;
  const output = peer.run(view, out);
  if (output === undefined) return { peer: name, milliseconds: undefined, differing: 0 };
  const vertices = new Uint32Array(new Uint8Array(readFileSync(out)).buffer);
  return { peer: name, milliseconds: JSON.parse(output) as number[], differing: differences(view, vertices) };
}

/** How many points have another label in the two answers. Equal points share a label. */
function differences({ cloud, viewpoint, radius, indices }: View, vertices: Uint32Array): number {
  const q = flip(cloud.positions, viewpoint, radius);
  const key = (i: number): string => `${q[3 * i]!},${q[3 * i + 1]!},${q[3 * i + 2]!}`;
  const ours = new Set(Array.from(indices, key));
  // The last vertex is the viewpoint.
  const theirs = new Set(
    Array.from(
      vertices.filter((i) => 3 * i < q.length),
      key,
    ),
  );
  let count = 0;
  for (let i = 0; 3 * i < q.length; i++) if (ours.has(key(i)) !== theirs.has(key(i))) count++;
  return count;
}

/** It takes seconds where the library takes milliseconds. So the dragon is its largest cloud. */
const three: Peer = {
  name: "three.js",
  version: (createRequire(import.meta.url)(join(root, "node_modules/three/package.json")) as { version: string })
    .version,
  takes: (cloud) => cloud.name.startsWith("dragon"),
  run({ cloud, viewpoint, radius }, out) {
    const [positions] = writeCloud(cloud);
    const args = [program("hull-peer"), positions, viewpoint.join(), String(radius), out];
    return ask(process.execPath, args, { timeout: PEER_LIMIT_MS });
  },
};

function scipy(): Peer[] {
  const python = withScipy();
  if (python === undefined) {
    console.error("Left out: SciPy needs Python 3 with pip.");
    return [];
  }
  const run = ({ cloud, viewpoint, radius }: View, out: string): string | undefined => {
    const runs = cloud.positions.length / 3 < LARGE ? 3 : 1;
    const args = [...writeCloud(cloud), viewpoint.join(), String(radius), String(runs), out];
    const script = join(root, "tests", "bench", "peers.py");
    return ask("python3", [script, ...args], { timeout: PEER_LIMIT_MS, env: python.env });
  };
  return [{ name: "SciPy", version: python.version, takes: () => true, run }];
}
