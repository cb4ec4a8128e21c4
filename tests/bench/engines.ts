// The builds that are timed. Each runs the same tasks in a process or page of its own,
// one after another.
import { readdirSync } from "node:fs";
import { join } from "node:path";

import type { Cloud } from "./clouds.js";
import type { Outcome, Task } from "./measure.js";
import { ask, program, root, writeCloud } from "./paths.js";

export interface Engine {
  name: string;
  takes: (cloud: Cloud) => boolean;
  measure(cloud: Cloud, tasks: Task[]): Promise<Outcome[]>;
}

/** The wasm binaries of the package, by their names in the tables. */
function wasmBuilds(): [name: string, file: string][] {
  const directory = join(root, "dist", "wasm");
  const simd = readdirSync(directory).find((file) => file.includes("simd") && file.endsWith(".wasm"));
  return [
    ["wasm", join(directory, "hpr_bg.wasm")],
    ...(simd === undefined ? [] : [["wasm SIMD", join(directory, simd)] as [string, string]]),
  ];
}

/** The engines that need no browser; the native one is the first. */
export function localEngines(): Engine[] {
  return [native, ...wasmBuilds().map(([name, file]) => wasmInNode(name, file))];
}

const native: Engine = {
  name: "native",
  takes: () => true,
  measure(cloud, tasks) {
    const program = join(root, "target", "release", "bench_native");
    const input = tasks.map(taskLine).join("\n");
    const lines = ask(program, writeCloud(cloud), { input })!.trim().split("\n");
    return Promise.resolve(lines.map((line) => JSON.parse(line) as Outcome));
  },
};

/** The task as one line of text, in the form that native.rs reads. */
function taskLine({ exponent, runs, viewpoint }: Task): string {
  return [exponent, runs, ...viewpoint].join(" ");
}

function wasmInNode(name: string, wasm: string): Engine {
  return {
    name,
    takes: () => true,
    measure(cloud, tasks) {
      const [file] = writeCloud(cloud);
      const output = ask(process.execPath, [program("node-engine"), wasm, file], { input: JSON.stringify(tasks) });
      return Promise.resolve(JSON.parse(output!) as Outcome[]);
    },
  };
}
