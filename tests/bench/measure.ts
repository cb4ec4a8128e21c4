// What one engine is asked, and the asking, in Node and in a page alike. The native
// build does the same in native.rs.
import { init, PointCloud } from "hidden-point-removal";

export type Point = [number, number, number];

/** What is measured at one exponent. */
export interface Task {
  exponent: number;
  /** Where the cold queries are asked from. */
  viewpoint: Point;
  /** A viewpoint from which nothing is known that helps at the others. */
  away: Point;
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
const BUILDS = 3;

/**
 * Cold means that nothing of an earlier view can help: before each cold query the
 * cloud is looked at from the other side, outside of the timed part.
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

  // Paths share viewpoints: each is asked cold once.
  const known = new Map<string, Answer>();
  const coldAt = (point: Point): Answer => {
    const key = point.join();
    const answer = known.get(key) ?? coldQuery(cloud, task, point);
    known.set(key, answer);
    return answer;
  };
  const paths = task.paths.map(([from, ...path]) => {
    const cold = path.map(coldAt);
    cloud.visibleFrom(from!, { exponent });
    const moving = path.map((point) => query(cloud, point, exponent));
    return { moving, cold };
  });
  return { cold: queries.map(({ milliseconds }) => milliseconds), visible, radius, digest, paths };
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
