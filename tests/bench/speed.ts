// Cold queries: the wasm under Node, the native build and, with --peers, SciPy's
// Qhull on the same flipped points, in one run.
import { spawnSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { PointCloud } from "hidden-point-removal";

import { bounds, type Cloud, root } from "./clouds.js";
import type { Row } from "./report.js";

const EXPONENTS = [2, 3, 4];
const RUNS = 9;
const PEER_RUNS = 3;

const scratch = join(root, "target", "bench-data");

/** One row for each exponent, seen from 2.5 bounding radii away. */
export function timeCloud(cloud: Cloud, python: string | undefined): Row[] {
  mkdirSync(scratch, { recursive: true });
  const file = join(scratch, `${cloud.name.replace(" ", "-")}.f32`);
  writeFileSync(file, cloud.positions);
  const { center, radius } = bounds(cloud);
  const viewpoint = center.map((x, axis) => x + radius * 2.5 * ([0.36, 0.48, 0.8][axis] ?? 0));

  const started = performance.now();
  const points = new PointCloud(cloud.positions);
  const build = performance.now() - started;
  const rows = EXPONENTS.map((exponent) => {
    const wasm: number[] = [];
    let answer = points.visibleFrom(viewpoint, { exponent });
    for (let run = 0; run < RUNS; run++) {
      const start = performance.now();
      answer = points.visibleFrom(viewpoint, { exponent });
      wasm.push(performance.now() - start);
    }
    const native = nativeTimes(file, viewpoint, exponent);
    if (native.visible !== answer.count) {
      throw new Error(`${cloud.name}: native sees ${native.visible}, wasm ${answer.count}`);
    }
    const row: Row = {
      cloud: cloud.name,
      points: points.length,
      exponent,
      visible: answer.count,
      "build ms": build,
      "wasm ms": median(wasm),
      "native ms": median(native.query_ms),
    };
    if (python === undefined) return row;
    const indices = join(scratch, "indices.u32");
    writeFileSync(indices, answer.indices);
    const peer = peerTimes(python, [file, viewpoint.join(","), String(answer.radius), indices]);
    return {
      ...row,
      "SciPy ms": median(peer.milliseconds),
      "SciPy ÷ wasm": median(peer.milliseconds) / median(wasm),
      "differing labels": peer.differences,
    };
  });
  points.dispose();
  return rows;
}

interface Native {
  visible: number;
  query_ms: number[];
}

function nativeTimes(file: string, viewpoint: number[], exponent: number): Native {
  const example = join(root, "target", "release", "examples", "bench_native");
  return run(example, [file, viewpoint.join(","), String(exponent), String(RUNS)]) as Native;
}

interface Peer {
  milliseconds: number[];
  differences: number;
}

function peerTimes(python: string, args: string[]): Peer {
  const script = join(root, "tests", "bench", "peers.py");
  return run(python, [script, ...args, String(PEER_RUNS)]) as Peer;
}

/** Runs a command that prints JSON. */
function run(command: string, args: string[]): unknown {
  const { status, stdout, stderr } = spawnSync(command, args, { encoding: "utf8" });
  if (status !== 0) throw new Error(`${command} failed: ${stderr}`);
  return JSON.parse(stdout) as unknown;
}

export function median(values: number[]): number {
  const sorted = values.toSorted((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)] ?? NaN;
}
