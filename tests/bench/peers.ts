// Hulls of other libraries on the same flipped points, with the same radius.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

import { Arbiter } from "./arbiter.js";
import { WrongAnswer } from "./check.js";
import type { Cloud } from "./clouds.js";
import { flip } from "./flip.js";
import type { Point } from "./measure.js";
import { ask, program, root, scratch, writeCloud } from "./paths.js";
import { withPython } from "./python.js";

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
  /** Whether it flips exactly as the library does. If so, the definition decides differences. */
  sameFlip: boolean;
}

/** A peer that has not finished after this time is stopped. */
export const PEER_LIMIT_MS = 120_000;
/** How many differing labels are checked one by one. The others are assumed to be like them. */
const JUDGED = 100;
/** The share of all points that may differ if a peer rounds its flips differently. */
const OTHER_ROUNDING = 1e-3;

/** The hulls of JavaScript libraries, and with `python` also SciPy and Open3D. */
export function peers(python: boolean): Peer[] {
  return [
    javascriptPeer("three", "three.js"),
    javascriptPeer("quickhull3d", "quickhull3d"),
    ...(python ? pythonPeers() : []),
  ];
}

/** Runs a peer on a view and checks the library's answer against its hull. */
export function compareWithPeer(peer: Peer, view: View): PeerResult {
  const out = scratch("vertices.u32");
  const output = peer.run(view, out);
  if (output === undefined) return { peer: peer.name, milliseconds: undefined, differing: 0 };
  const vertices = new Uint32Array(new Uint8Array(readFileSync(out)).buffer);
  return { peer: peer.name, milliseconds: JSON.parse(output) as number[], differing: judge(peer, view, vertices) };
}

function judge(peer: Peer, view: View, vertices: Uint32Array): number {
  const { cloud, exponent, viewpoint, radius } = view;
  const q = flip(cloud.positions, viewpoint, radius);
  const differing = differences(q, view.indices, vertices);
  const where = `${cloud.name}, exponent ${exponent}: ${peer.name}`;
  if (!peer.sameFlip) {
    if (differing.length <= OTHER_ROUNDING * (q.length / 3)) return differing.length;
    throw new WrongAnswer(`${where} sees ${differing.length} points differently`);
  }
  if (differing.length === 0) return 0;
  const arbiter = new Arbiter(q);
  const ours = new Set(view.indices);
  const every = Math.ceil(differing.length / JUDGED);
  const mistakes = differing.filter((p, i) => i % every === 0 && ours.has(p) !== arbiter.visible(p));
  if (mistakes.length === 0) return differing.length;
  throw new WrongAnswer(`${where} is right about the points ${mistakes.join(", ")}, and the library is wrong`);
}

/** The points whose labels differ between the two answers. Equal points share a label. */
function differences(q: Float64Array, visible: Uint32Array, vertices: Uint32Array): number[] {
  const count = q.length / 3;
  const key = (i: number): string => `${q[3 * i]!},${q[3 * i + 1]!},${q[3 * i + 2]!}`;
  const ours = new Uint8Array(count);
  const theirs = new Uint8Array(count);
  const seen = new Set<string>();
  for (const i of visible) ours[i] = 1;
  for (const i of vertices) {
    if (i >= count) continue; // The viewpoint.
    theirs[i] = 1;
    seen.add(key(i));
  }
  for (let i = 0; i < count; i++) if (theirs[i] === 0 && seen.has(key(i))) theirs[i] = 1;
  return Array.from(ours.keys()).filter((i) => ours[i] !== theirs[i]);
}

/** The JavaScript hulls take seconds, the library takes milliseconds. So the dragon is the largest cloud for them. */
function javascriptPeer(library: string, name: string): Peer {
  const file = join(root, "node_modules", library, "package.json");
  return {
    name,
    version: (createRequire(import.meta.url)(file) as { version: string }).version,
    takes: (cloud) => cloud.name.startsWith("dragon"),
    run({ cloud, viewpoint, radius }, out) {
      const [positions] = writeCloud(cloud);
      const args = [program("hull-peer"), library, positions, viewpoint.join(), String(radius), out];
      return ask(process.execPath, args, { timeout: PEER_LIMIT_MS });
    },
    sameFlip: true,
  };
}

/** From this number of points on, one run of a peer is enough. */
const LARGE = 500_000;

function pythonPeers(): Peer[] {
  const packages = [
    { module: "scipy", name: "SciPy", install: ["scipy"], sameFlip: true },
    // The smaller package, without CUDA, exists for some platforms only.
    { module: "open3d", name: "Open3D", install: ["open3d-cpu", "open3d"], sameFlip: false },
  ];
  return packages.flatMap(({ module, name, install, sameFlip }) => {
    const python = withPython(module, install);
    if (python === undefined) {
      console.error(`Left out: ${name} needs Python 3 with pip.`);
      return [];
    }
    const run = ({ cloud, viewpoint, radius }: View, out: string): string | undefined => {
      const runs = cloud.positions.length / 3 < LARGE ? 3 : 1;
      const args = [module, ...writeCloud(cloud), viewpoint.join(), String(radius), String(runs), out];
      return ask("python3", [join(root, "tests", "bench", "peers.py"), ...args], {
        timeout: PEER_LIMIT_MS,
        env: python.env,
      });
    };
    return [{ name, version: python.version, takes: () => true, run, sameFlip }];
  });
}
