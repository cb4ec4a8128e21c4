// Clouds with known visibility: scanned clouds, whose ray-traced labels come from HPR_SHARED,
// and generated clouds, which are ray-traced here.
import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import type { Mesh } from "../../www/samples/generator.js";
import { bunny36k, type Cloud, dragon, sharedFile } from "../bench/clouds.js";
import { direction } from "../bench/generators.js";
import type { Point } from "../bench/measure.js";
import { bounds } from "../bench/views.js";
import { later } from "./later.js";
import { dragonMesh, type MeshPoints, RayTracer } from "./rays.js";
import { bumpySphere, room, scatter, torus } from "./shapes.js";
import { decimated, type Half, HALVES, uneven } from "./uneven.js";

export interface Labelled {
  name: string;
  positions: Float32Array | Float64Array;
  views: View[];
}

export interface View {
  viewpoint: Point;
  /** One byte for each point: 1 if it can be seen from the viewpoint. */
  seen: Uint8Array;
  /** The error of the best R, in % of all points, if it is known. */
  best?: number;
}

type Loader = () => Cloud | undefined;

const SCANNED: [string, Loader][] = [
  ["dragon_res2", () => dragon("dragon_res2")],
  ["dragon_res3", () => dragon("dragon_res3")],
  ["stanford-bunny", bunny36k],
];

/** The available scanned clouds, with the views whose best error is known. */
export function* scanned(): Generator<Labelled> {
  const reference = sharedFile("truth", "reference.json");
  if (reference === undefined) return;
  const best = JSON.parse(readFileSync(reference, "utf8")) as Record<string, { lin_best: number } | undefined>;
  for (const [name, load] of SCANNED) {
    const cloud = load();
    const json = sharedFile("truth", `${name}.json`);
    const labels = sharedFile("truth", `${name}.u8.gz`);
    if (cloud === undefined || json === undefined || labels === undefined) continue;
    const count = cloud.positions.length / 3;
    const { views } = JSON.parse(readFileSync(json, "utf8")) as { views: { viewpoint: Point }[] };
    const bytes = gunzipSync(readFileSync(labels));
    yield {
      name,
      positions: cloud.positions,
      views: views.flatMap(({ viewpoint }, i) => {
        const known = best[`${name}/${i}`];
        return known === undefined
          ? []
          : [{ viewpoint, seen: bytes.subarray(i * count, (i + 1) * count), best: known.lin_best }];
      }),
    };
  }
}

/** Random points on generated surfaces, at several densities, even and uneven. */
export function* generated(): Generator<Labelled> {
  const ring = torus();
  for (const count of [5_000, 20_000, 80_000]) yield fromOutside("torus", ring, scatter(ring, count, 11));
  // One end is twenty times as dense as the other.
  yield fromOutside(
    "torus, uneven 20:1",
    ring,
    scatter(ring, 20_000, 12, ([x]) => 20 ** (x / 2.8)),
  );
  const bumpy = bumpySphere();
  for (const count of [10_000, 40_000]) yield fromOutside("bumpy sphere", bumpy, scatter(bumpy, count, 13));
  yield fromOutside(
    "bumpy sphere, uneven 20:1",
    bumpy,
    scatter(bumpy, 40_000, 14, ([x]) => 20 ** (x / 2)),
  );
  const furnished = room();
  for (const count of [20_000, 100_000]) {
    yield traced("room, from inside", furnished, scatter(furnished, count, 15), INSIDE);
  }
}

/** Surfaces that are sampled unevenly. */
export async function* unevenly(half: Half): AsyncGenerator<Labelled> {
  for (const { name, mesh, points } of uneven(half)) yield fromOutside(name, mesh, points ?? mesh);
  const [file, share] = half === HALVES[0] ? (["dragon_res3", 0.3] as const) : (["dragon_res2", 0.12] as const);
  const { name, mesh } = await decimated(file, dragonMesh(file), share);
  yield fromOutside(name, mesh, mesh);
}

/** Surfaces that were made after all rules had been chosen. */
export function* madeLater(): Generator<Labelled> {
  for (const { name, mesh, points } of later()) yield fromOutside(name, mesh, points ?? mesh);
}

/** A viewpoint between the furniture, in meters. */
const INSIDE = [-2.2, -0.5, 0.6, 1.9].flatMap((x) => [-1.6, 1.6].map((z): Point => [x, 1.6, z]));

const DISTANCES = [2.5, 1.3];
const DIRECTIONS = 4;

/** Viewpoints around the cloud, at 2.5 and 1.3 radii of its box's corner sphere. */
function fromOutside(name: string, mesh: Mesh, points: MeshPoints): Labelled {
  const { center, radius } = bounds(points);
  const viewpoints = DISTANCES.flatMap((distance) =>
    Array.from({ length: DIRECTIONS }, (_, i) => {
      const towards = direction(1 - (2 * i + 1) / DIRECTIONS, 0.618 * i + 0.1);
      return center.map((x, axis) => x + distance * radius * towards[axis]!) as Point;
    }),
  );
  return traced(name, mesh, points, viewpoints);
}

function traced(name: string, mesh: Mesh, points: MeshPoints, viewpoints: Point[]): Labelled {
  const tracer = new RayTracer(mesh);
  return {
    name,
    positions: points.positions,
    views: viewpoints.map((viewpoint) => ({ viewpoint, seen: tracer.visibleFrom(viewpoint, points) })),
  };
}
