// Clouds whose points are labeled, from HPR_SHARED: thin shapes, real scans, and simulated ones with noise, gaps and outliers.
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { gunzipSync } from "node:zlib";

import { sharedFile } from "../bench/clouds.js";
import type { Point } from "../bench/measure.js";
import { scanned } from "./truth.js";

export interface Judged {
  /** The row of the table to which its views belong. */
  row: string;
  name: string;
  positions: Float32Array | Float64Array;
  /** Whether its unit is the meter, so that thresholds in meters mean something. */
  isMetric: boolean;
  views: JudgedView[];
}

/** The label of points that are not judged. */
const UNKNOWN = 255;

export interface JudgedView {
  viewpoint: Point;
  /** For each point: 0 hidden, 1 visible, another number where nobody knows. */
  labels: Uint8Array;
  /** 0: rules are chosen on it, 1: only reported. By the number of the view, or of the cloud where it has one view. */
  half: number;
}

/** The rows of scans. Others are named by the first part of their names. */
const ROWS: Record<string, string> = {
  "7s_2": "7-Scenes, voxels of 2 cm",
  "7s_4": "7-Scenes, voxels of 4 cm",
  k07: "KITTI 07, five scans",
  own_3dtk_0: "own station: laser, indoors",
  own_7s_10: "own station: RGB-D frame",
  own_k00_0: "own station: KITTI 00",
  own_k07_0: "own station: KITTI 07 in voxels",
  own_nus: "own station: nuScenes",
  own_lpmcar0: "own station: Velodyne",
  own_pclroom1: "own station: laser, a room",
  rgbd_slambook_15_1: "RGB-D rooms (slambook)",
  rgbd_slambook_30_3: "RGB-D rooms (slambook)",
  rgbd_pclpair_3: "pair of Kinect frames",
  obj_dragon_48: "raw scans of objects (Stanford)",
  obj_bunny_090: "raw scans of objects (Stanford)",
  lidar_lpmcar3: "Velodyne, three scans",
  lidar_gicp2: "KITTI, two scans",
  aerial_topography: "airborne laser",
  sfm_cup: "structure from motion",
  mvs_sparse: "multi-view stereo, sparse",
};
const METRIC = /^(aerial_0|rgbd_8|tls|thin_(fence|scaffold))/;

/** The available clouds. There are none without HPR_SHARED. */
export function* judged(): Generator<Judged> {
  for (const [from, example] of [
    ["thin", "thin_chair_8k_0"],
    ["real", "k07"],
    ["real2", "sfm_cup"],
  ] as const) {
    yield* folder(from, example, ({ name, path, count }, views) => {
      const labels = unzipped(`${path}.lab.gz`);
      const of = views.map((_, view) => labels.subarray(view * count, (view + 1) * count));
      const row = ROWS[name] ?? `thin shapes: ${name.split("_")[1]!.replace(/[\d.]+$/, "")}`;
      return { row, isMetric: from === "real", labels: of };
    });
  }
  for (const from of ["noisy", "lidar"]) {
    yield* folder(from, from === "noisy" ? "tls_0p8_village_5" : "reference", ({ name, path, count }, views) => {
      const isLidar = from === "lidar";
      const row = isLidar ? "simulated lidar" : `simulated: ${name.split("_")[0]!}`;
      const [seen, unknown] = [unzipped(`${path}.u8.gz`), unzipped(`${path}.k8.gz`)];
      const labels = views.map((_, view) => {
        // What only surfaces without points hide, no method can know.
        const isUnknown = unpacked(unknown, view, count);
        return unpacked(seen, view, count).map((label, i) => (label === 0 && isUnknown[i] === 1 ? UNKNOWN : label));
      });
      return { row, isMetric: isLidar || METRIC.test(name), labels };
    });
  }
  for (const { name, positions, views } of scanned()) {
    const judged = views.map(({ viewpoint, seen }, view) => ({ viewpoint, labels: seen, half: view % 2 }));
    yield { row: "scanned surfaces, clean", name, positions, isMetric: false, views: judged };
  }
}

interface Files {
  name: string;
  path: string;
  count: number;
}

/** The clouds of a folder that holds `example`.json. */
function* folder(
  from: string,
  example: string,
  read: (files: Files, views: Point[]) => { row: string; isMetric: boolean; labels: Uint8Array[] },
): Generator<Judged> {
  const first = sharedFile(from, `${example}.json`);
  if (first === undefined) return;
  const names = readdirSync(dirname(first)).flatMap((file) => /^(.+)\.f32\.gz$/.exec(file)?.[1] ?? []);
  for (const [number, name] of names.sort().entries()) {
    const path = join(dirname(first), name);
    const positions = new Float32Array(Uint8Array.from(unzipped(`${path}.f32.gz`)).buffer);
    const file = JSON.parse(readFileSync(`${path}.json`, "utf8")) as { views: { viewpoint: Point }[] };
    const viewpoints = file.views.map(({ viewpoint }) => viewpoint);
    const { labels, ...rest } = read({ name, path, count: positions.length / 3 }, viewpoints);
    const half = (view: number) => (viewpoints.length > 1 ? view : number) % 2;
    const views = viewpoints.map((viewpoint, i) => ({ viewpoint, labels: labels[i]!, half: half(i) }));
    yield { ...rest, name, positions, views };
  }
}

function unzipped(path: string): Uint8Array {
  return gunzipSync(readFileSync(path));
}

/** Makes a byte for each point from its bit. The first point is in the highest bit. Each view starts at a new byte. */
function unpacked(packed: Uint8Array, view: number, count: number): Uint8Array {
  const start = view * Math.ceil(count / 8);
  return Uint8Array.from({ length: count }, (_, i) => (packed[start + (i >> 3)]! >> (7 - (i & 7))) & 1);
}
