// The paths of files, and how other programs are run.
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { root } from "../root.js";

export { root };

/** A program of this directory that runs in a process of its own. */
export function program(name: string): string {
  return join(import.meta.dirname, `${name}.js`);
}

/** A file for other programs to read or write. */
export function scratch(name: string): string {
  const directory = join(root, "target", "bench-data");
  mkdirSync(directory, { recursive: true });
  return join(directory, name);
}

export type Precision = "f32" | "f64";

/** The part of a cloud that a file for other programs needs. */
interface Named {
  name: string;
  positions: Float32Array | Float64Array;
}

/** The cloud's positions as raw little-endian numbers in a file, and their precision. */
export function writeCloud(cloud: Named): [file: string, precision: Precision] {
  const { name, positions } = cloud;
  const precision = positions.BYTES_PER_ELEMENT === 4 ? "f32" : "f64";
  const file = scratch(`${name}.${precision}`);
  writeFileSync(file, positions);
  return [file, precision];
}

/** Reads a file that `writeCloud` wrote. */
export function readCloud(file: string): Float32Array | Float64Array {
  const { buffer } = new Uint8Array(readFileSync(file));
  return file.endsWith(".f32") ? new Float32Array(buffer) : new Float64Array(buffer);
}

const LARGEST_OUTPUT = 2 ** 28;

/** The output of a program, or undefined if it was stopped after `timeout` milliseconds. */
export function ask(
  command: string,
  args: string[],
  { input = "", timeout, env = {} }: { input?: string; timeout?: number; env?: Record<string, string> } = {},
): string | undefined {
  const { status, stdout, stderr, error } = spawnSync(command, args, {
    encoding: "utf8",
    input,
    env: { ...process.env, ...env },
    maxBuffer: LARGEST_OUTPUT,
    killSignal: "SIGKILL",
    ...(timeout === undefined ? {} : { timeout }),
  });
  if (error !== undefined && "code" in error && error.code === "ETIMEDOUT") return undefined;
  if (status !== 0) throw new Error(`${command} ${args.join(" ")} failed: ${error?.message ?? stderr}`);
  return stdout;
}
