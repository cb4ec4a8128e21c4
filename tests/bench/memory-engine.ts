// The memory of the wasm in a process of its own: memory-engine.js CLOUD < WORK, where
// WORK is JSON. The memory never shrinks, so its size at the end is the peak.
import { readFileSync } from "node:fs";

import { init, PointCloud } from "hidden-point-removal";

import { digestOf, type Point } from "./measure.js";
import { readCloud } from "./paths.js";

export interface MemoryWork {
  views: Point[];
  /** How often all views are asked, one after another. */
  rounds: number;
  /** 0 for the automatic radius. */
  exponent: number;
}

export interface MemoryUse {
  /** Bytes after building the cloud, and after each round. */
  built: number;
  rounds: number[];
  visible: number;
  milliseconds: { build: number; query: number };
}

const memory = watchMemory();
await init();
const [file] = process.argv.slice(2);
const { views, rounds, exponent } = JSON.parse(readFileSync(0, "utf8")) as MemoryWork;
const positions = readCloud(file!);

let start = performance.now();
const cloud = new PointCloud(positions);
const build = performance.now() - start;
const built = memory();
start = performance.now();
const first = views.map((view) => ask(view));
const query = (performance.now() - start) / views.length;
const after = [memory()];
while (after.length < rounds) {
  views.forEach((view, i) => {
    if (ask(view).digest !== first[i]!.digest) throw new Error(`view ${i + 1} has another answer than before`);
  });
  after.push(memory());
}
const visible = Math.max(...first.map(({ count }) => count));
console.log(JSON.stringify({ built, rounds: after, visible, milliseconds: { build, query } } satisfies MemoryUse));

function ask(view: Point): { count: number; digest: string } {
  const { count, indices } = cloud.visibleFrom(view, exponent === 0 ? {} : { exponent });
  return { count, digest: digestOf(indices) };
}

/** The package does not export its instance, so the memory is caught when it is made. */
function watchMemory(): () => number {
  const { instantiate } = WebAssembly;
  let exports: WebAssembly.Exports | undefined;
  WebAssembly.instantiate = (async (module: WebAssembly.Module, imports?: WebAssembly.Imports) => {
    const instance = await instantiate(module, imports);
    exports = instance.exports;
    return instance;
  }) as typeof instantiate;
  return () => (exports!["memory"] as WebAssembly.Memory).buffer.byteLength;
}
