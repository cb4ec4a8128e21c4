// What one engine is asked, and the asking, in Node and in a page alike. The native
// build does the same in native.rs.
import { init, PointCloud } from "hidden-point-removal";

export type Point = [number, number, number];

/** What is measured at one exponent. */
export interface Task {
  exponent: number;
  /** Where the cold queries are asked from. */
  viewpoint: Point;
  /** How many cold queries are timed. */
  runs: number;
  /** Each a viewpoint that is left and the viewpoints moved through, one step after another. */
  paths: Point[][];
}

/** Milliseconds and answers; what checks them is check.ts. */
export interface Outcome {
  build: number[];
  cold: number[];
  visible: number;
  radius: number;
  /** Of the visible set, see `digestOf`. */
  digest: string;
  paths: { moving: Answer[]; cold: Answer[] }[];
}

export interface Answer {
  milliseconds: number;
  digest: string;
}

/** Queries until the engine has compiled what is hot: at least two, and this long. */
const WARM_UP_MS = 600;

/**
 * Cold means that nothing of an earlier view can help: each cold query is the first
 * one of a cloud built for it, outside of the timed part.
 */
export async function measure(
  wasm: string | URL,
  positions: Float32Array | Float64Array,
  tasks: Task[],
): Promise<Outcome[]> {
  await init(wasm);
  const [first] = tasks;
  if (first === undefined) return [];
  const started = performance.now();
  for (let asked = 0; asked < 2 || performance.now() - started < WARM_UP_MS; asked++) {
    coldQuery(positions, first.viewpoint, first.exponent);
  }
  return tasks.map((task) => outcomeOf(positions, task));
}

function outcomeOf(positions: Float32Array | Float64Array, task: Task): Outcome {
  const { exponent, viewpoint, runs } = task;
  const queries = Array.from({ length: runs }, () => coldQuery(positions, viewpoint, exponent));
  const digests = new Set(queries.map(({ digest }) => digest));
  if (digests.size !== 1) throw new Error(`${runs} cold queries at exponent ${exponent} gave ${digests.size} answers`);
  const { visible, radius, digest } = queries[0]!;

  // Paths share viewpoints: each is asked cold once.
  const known = new Map<string, Answer>();
  const coldAt = (point: Point): Answer => {
    const key = point.join();
    const answer = known.get(key) ?? coldQuery(positions, point, exponent);
    known.set(key, answer);
    return answer;
  };
  const paths = task.paths.map(([from, ...path]) => {
    const cold = path.map(coldAt);
    const cloud = new PointCloud(positions);
    cloud.visibleFrom(from!, { exponent });
    const moving = path.map((point) => query(cloud, point, exponent));
    cloud.dispose();
    return { moving, cold };
  });
  return {
    build: queries.map(({ build }) => build),
    cold: queries.map(({ milliseconds }) => milliseconds),
    visible,
    radius,
    digest,
    paths,
  };
}

function coldQuery(positions: Float32Array | Float64Array, viewpoint: Point, exponent: number) {
  const start = performance.now();
  const cloud = new PointCloud(positions);
  const build = performance.now() - start;
  const answer = query(cloud, viewpoint, exponent);
  cloud.dispose();
  return { build, ...answer };
}

function query(cloud: PointCloud, viewpoint: Point, exponent: number) {
  const start = performance.now();
  const { indices, count, radius } = cloud.visibleFrom(viewpoint, { exponent });
  const milliseconds = performance.now() - start;
  return { milliseconds, visible: count, radius, digest: digestOf(indices) };
}

/** FNV-1a over 32-bit words, twice with different constants; native.rs has the same. */
export function digestOf(indices: Uint32Array): string {
  let a = 0x811c9dc5;
  let b = 0x9e3779b9;
  for (const index of indices) {
    a = Math.imul(a ^ index, 0x01000193);
    b = Math.imul(b ^ index, 0x85ebca6b);
    b = (b << 13) | (b >>> 19);
  }
  return [a, b].map((word) => (word >>> 0).toString(16).padStart(8, "0")).join("");
}
