// Simulated lidar from HPR_SHARED/lidar, with ray-cast truth.
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { gunzipSync } from "node:zlib";

import { sharedFile } from "../bench/clouds.js";
import type { Point } from "../bench/measure.js";

export interface LidarScene {
  name: string;
  positions: Float32Array;
  views: LidarView[];
}

export interface LidarView {
  viewpoint: Point;
  /** One byte for each point: 1 if it can be seen from the viewpoint. */
  seen: Uint8Array;
  /** 1 for points that are hidden only by surfaces without a point in the cloud. No method can know that these are hidden. */
  unknowable: Uint8Array;
}

/** The available scenes, by name. */
export function* lidarScenes(): Generator<LidarScene> {
  const reference = sharedFile("lidar", "reference.json");
  if (reference === undefined) return;
  const folder = dirname(reference);
  for (const file of readdirSync(folder).filter((file) => file.endsWith(".f32.gz"))) {
    const name = file.slice(0, -".f32.gz".length);
    const { n, views } = JSON.parse(readFileSync(join(folder, `${name}.json`), "utf8")) as {
      n: number;
      views: { viewpoint: Point }[];
    };
    const bytes = gunzipSync(readFileSync(join(folder, file)));
    const [seen, unknowable] = ["u8", "k8"].map((kind) => {
      const packed = gunzipSync(readFileSync(join(folder, `${name}.${kind}.gz`)));
      return views.map((_, view) => unpacked(packed, view, n));
    });
    yield {
      name,
      positions: new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)),
      views: views.map(({ viewpoint }, i) => ({ viewpoint, seen: seen![i]!, unknowable: unknowable![i]! })),
    };
  }
}

/** Makes a byte for each point from its bit. The first point is in the highest bit. Each view starts at a new byte. */
function unpacked(packed: Uint8Array, view: number, count: number): Uint8Array {
  const start = view * Math.ceil(count / 8);
  return Uint8Array.from({ length: count }, (_, i) => (packed[start + (i >> 3)]! >> (7 - (i & 7))) & 1);
}
