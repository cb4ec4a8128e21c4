// The builds that are timed. Each runs the same tasks in a process of its own, one after another.
import { join } from "node:path";

import type { Cloud } from "./clouds.js";
import type { Outcome, Task } from "./measure.js";
import { ask, program, root, writeCloud } from "./paths.js";

export type Engine = (cloud: Cloud, tasks: Task[]) => Outcome[];

/** By their names in the tables. */
export const ENGINES: Record<string, Engine> = { native, wasm };

function native(cloud: Cloud, tasks: Task[]): Outcome[] {
  const program = join(root, "target", "release", "bench_native");
  // One line for each task, in the form that native.rs reads.
  const input = tasks.map(({ exponent, runs, viewpoint }) => [exponent, runs, ...viewpoint].join(" ")).join("\n");
  const lines = ask(program, writeCloud(cloud), { input })!.trim().split("\n");
  return lines.map((line) => JSON.parse(line) as Outcome);
}

function wasm(cloud: Cloud, tasks: Task[]): Outcome[] {
  const [file] = writeCloud(cloud);
  const args = [program("node-engine"), join(root, "dist", "wasm", "hpr_bg.wasm"), file];
  return JSON.parse(ask(process.execPath, args, { input: JSON.stringify(tasks) })!) as Outcome[];
}
