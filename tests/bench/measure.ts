// The queries of one engine, and how they are timed, in Node. native.rs does
// the same for the native build.
import { init, PointCloud } from "hidden-point-removal";

export type Point = [number, number, number];

/** The measurements at one exponent. */
export interface Task {
  exponent: number;
  /** The viewpoint of the cold queries. */
  viewpoint: Point;
  /** A viewpoint whose answer does not help at the other viewpoints. */
  away: Point;
  /** How many cold queries are timed. */
  runs: number;
}

/** Milliseconds and answers. check.ts checks the answers. */
export interface Outcome {
  build: number[];
  cold: number[];
  visible: number;
  radius: number;
  /** The digest of the visible set, see `digestOf`. */
  digest: string;
}

/** Queries run for this time before the timing, and at least two of them. So the engine compiles the hot code. */
const WARM_UP_MS = 600;
const BUILDS = 3;

/**
 * Cold means that no earlier view can help. Before each cold query the cloud is looked at
 * from the other side. This is not timed.
 */
export async function measure(
  wasm: string | URL,
  positions: Float32Array | Float64Array,
  tasks: Task[],
): Promise<Outcome[]> {
  await init(wasm);
  const [first] = tasks;
  if (first === undefined) return [];
  const build = Array.from({ length: BUILDS }, () => {
    const start = performance.now();
    new PointCloud(positions).dispose();
    return performance.now() - start;
  });
  const cloud = new PointCloud(positions);
  const started = performance.now();
  for (let asked = 0; asked < 2 || performance.now() - started < WARM_UP_MS; asked++) {
    coldQuery(cloud, first, first.viewpoint);
  }
  const outcomes = tasks.map((task) => ({ build, ...outcomeOf(cloud, task) }));
  cloud.dispose();
  return outcomes;
}

function outcomeOf(cloud: PointCloud, task: Task): Omit<Outcome, "build"> {
  const { exponent, viewpoint, runs } = task;
  const queries = Array.from({ length: runs }, () => coldQuery(cloud, task, viewpoint));
  const digests = new Set(queries.map(({ digest }) => digest));
  if (digests.size !== 1) throw new Error(`${runs} cold queries at exponent ${exponent} gave ${digests.size} answers`);
  const { visible, radius, digest } = queries[0]!;

  return { cold: queries.map(({ milliseconds }) => milliseconds), visible, radius, digest };
}

function coldQuery(cloud: PointCloud, { away, exponent }: Task, viewpoint: Point) {
  cloud.visibleFrom(away, { exponent });
  return query(cloud, viewpoint, exponent);
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
