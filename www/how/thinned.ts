import { WorkerPointCloud } from "hidden-point-removal/worker";
import type { Cloud } from "../cloud/cloud.ts";
import type { Viewpoint } from "../settings/settings.ts";

/** So many points can be told apart in a small picture. */
const MOST = 4000;

/** What the hull says about the thinned cloud for one radius. */
export interface Flipped {
  /** The radius R of the sphere, in units of the cloud. */
  radius: number;
  /** 1 for each visible point. */
  visible: Uint8Array;
  /** The faces of the hull between visible points: three points each. */
  faces: Uint32Array;
}

/** An even share of a cloud, in a worker of its own, as one viewpoint sees it. */
export class Thinned {
  /** Coordinates measured from the viewpoint. */
  readonly positions: Float32Array;
  readonly distances: Float32Array;
  readonly count: number;
  readonly farthest: number;
  /** The exponent of the automatic radius. */
  readonly automatic: number;
  readonly #points: WorkerPointCloud;

  private constructor(points: WorkerPointCloud, positions: Float32Array, automatic: number) {
    this.#points = points;
    this.positions = positions;
    this.count = positions.length / 3;
    this.automatic = automatic;
    this.distances = new Float32Array(this.count);
    for (let i = 0; i < this.count; i++) {
      this.distances[i] = Math.hypot(positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!);
    }
    this.farthest = this.distances.reduce((a, b) => Math.max(a, b), 0);
  }

  static async of({ local, count, center }: Cloud, viewpoint: Viewpoint): Promise<Thinned> {
    const step = Math.ceil(count / MOST);
    const eye = viewpoint.map((value, axis) => value - center[axis]!);
    const positions = new Float32Array(3 * Math.ceil(count / step));
    for (let i = 0; i < positions.length / 3; i++) {
      for (let axis = 0; axis < 3; axis++) positions[3 * i + axis] = local[3 * i * step + axis]! - eye[axis]!;
    }
    const points = await WorkerPointCloud.create(positions, { workers: 1 });
    const { exponent } = await points.autoRadius([0, 0, 0]);
    return new Thinned(points, positions, exponent);
  }

  /** Rejects with an AbortError if a newer radius is asked for. */
  async flip(exponent: number): Promise<Flipped> {
    const answer = await this.#points.reconstruct([0, 0, 0], { exponent, maxEdge: Infinity, latest: true });
    return { radius: answer.radius, visible: answer.mask(), faces: answer.triangles };
  }

  dispose(): void {
    void this.#points.dispose();
  }
}
