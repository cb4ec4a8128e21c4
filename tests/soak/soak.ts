// Long checks of the package. Viewpoints move through clouds in workers all day, and points come and go: answers
// stay right, and memory stays flat. Each map of a turn around a large cloud is compared. And one large cloud is asked
// from end to end.
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { HprError, init, PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { bumpy, bumpyFiveMillion } from "../bench/clouds.js";
import { bumpySurface, seeded, terrainUtm, unevenSurface } from "../bench/generators.js";
import { turn } from "../bench/maps.js";

type Place = [number, number, number];

/** One cloud, and its use. The viewpoint stays within `reach` of the middle. Points change after so many views. */
interface Subject {
  positions: Float32Array | Float64Array;
  placement: { workers?: number; shared?: boolean };
  middle: Place;
  reach: number;
  changes?: number;
}

const SUBJECTS: readonly Subject[] = [
  { positions: bumpySurface(50_000, 1), placement: {}, middle: [0, 0, 0], reach: 3 },
  { positions: unevenSurface(5_000, 2), placement: { workers: 2 }, middle: [0, 0, 0], reach: 2 },
  { positions: terrainUtm(3_000, 3), placement: { workers: 1 }, middle: [400_500, 5_000_500, 100], reach: 400 },
  { positions: bumpySurface(1_000, 5), placement: { shared: true }, middle: [0, 0, 0], reach: 2, changes: 50 },
];

/** Asks `count` views. The clouds take turns. One view in 100 is compared with the answer of a new cloud. */
export async function views(count: number): Promise<boolean> {
  const random = seeded(20261122);
  const walkers = await Promise.all(SUBJECTS.map((subject) => Walker.start(subject, random)));
  let [checked, wrong, first, last] = [0, 0, 0, 0];
  for (let view = 1; view <= count; view++) {
    await walkers[view % walkers.length]!.step();
    if (view % 100 === 0) {
      checked += 1;
      wrong += (await walkers[(view / 100) % walkers.length]!.isRight()) ? 0 : 1;
    }
    if (view % Math.ceil(count / 10) === 0 || view === count) {
      last = await resident();
      first ||= last;
      console.log(`${view} views: ${checked} compared, ${wrong} wrong, the process holds ${last.toFixed(0)} MB`);
    }
  }
  await Promise.all(walkers.map((walker) => walker.end()));
  return wrong === 0 && last < 1.1 * first;
}

/** A viewpoint that moves through a cloud, mostly by small steps. */
class Walker {
  readonly #subject: Subject;
  readonly #cloud: WorkerPointCloud;
  readonly #random: () => number;
  #place: Place;
  #views = 0;
  /** All positions that the cloud ever got. `#removed` holds the indices of the removed points. */
  readonly #given: number[];
  readonly #removed = new Set<number>();

  private constructor(subject: Subject, cloud: WorkerPointCloud, random: () => number) {
    const [x, y, z] = subject.middle;
    [this.#subject, this.#cloud, this.#random] = [subject, cloud, random];
    this.#place = [x, y, z + 0.8 * subject.reach];
    this.#given = [...subject.positions];
  }

  static async start(subject: Subject, random: () => number): Promise<Walker> {
    return new Walker(subject, await WorkerPointCloud.create(subject.positions, subject.placement), random);
  }

  async step(): Promise<void> {
    const { middle, reach, changes } = this.#subject;
    const jump = this.#random() < 0.02;
    const size = reach * (jump ? 2 : 0.02);
    this.#place = this.#place.map((x, axis) => {
      const from = jump ? middle[axis]! : x;
      const to = from + size * (this.#random() - 0.5);
      // A step beyond the reach goes to the mirror image of the place, on the other side of the middle.
      return Math.abs(to - middle[axis]!) > reach ? 2 * middle[axis]! - from : to;
    }) as Place;
    this.#views += 1;
    if (changes !== undefined && this.#views % changes === 0) await this.#change();
    await this.#cloud.visibleFrom(this.#place);
  }

  /** Asks a new cloud of the present points, in an instance of its own, and compares the answers. */
  async isRight(): Promise<boolean> {
    const given = this.#given;
    const kept = Array.from({ length: given.length / 3 }, (_, i) => i).filter((i) => !this.#removed.has(i));
    const points = kept.flatMap((i) => given.slice(3 * i, 3 * i + 3));
    const cold = await WorkerPointCloud.create(points, { workers: 1 });
    const expected = await cold.visibleFrom(this.#place);
    await cold.dispose();
    const { indices, radius } = await this.#cloud.visibleFrom(this.#place);
    const same = indices.every((index, i) => index === kept[expected.indices[i]!]);
    return same && radius === expected.radius && indices.length === expected.count;
  }

  async end(): Promise<void> {
    await this.#cloud.dispose();
  }

  /** Removes and appends equally many points. No index is used twice. */
  async #change(): Promise<void> {
    const count = this.#given.length / 3;
    const present = Array.from({ length: count }, (_, i) => i).filter((i) => !this.#removed.has(i));
    const start = Math.floor(this.#random() * (present.length - 20));
    const gone = present.slice(start, start + 20);
    const more = Array.from({ length: 60 }, () => 2 * this.#random() - 1);
    for (const index of gone) this.#removed.add(index);
    this.#given.push(...more);
    await Promise.all([this.#cloud.remove(gone), this.#cloud.append(more)]);
  }
}

/** Compares each map of a full turn with the exact answer of its viewpoint. A map that hides a visible point throws. */
export async function maps(): Promise<boolean> {
  await init();
  const rows = [
    turn(bumpy("bumpy-1m"), {}, 1),
    turn(bumpy("bumpy-1m"), { looks: 3 }, 1),
    turn(bumpyFiveMillion(), {}, 1),
  ];
  for (const row of rows) console.log(row);
  return rows.every((row) => Number(row["wrong, worst %"]) <= 1);
}

/** Asks one large cloud, here and in a worker; both give the same points. A refusal says its code. */
export async function large(points: number): Promise<boolean> {
  const positions = bumpySurface(points, 4);
  const [place, view] = [[0, 0, 5] as Place, { exponent: 3 }];
  try {
    await init();
    const cloud = timed("built", () => new PointCloud(positions));
    const { indices } = timed("view", () => cloud.visibleFrom(place, view));
    cloud.dispose();
    const worker = await WorkerPointCloud.create(positions);
    const shared = (await worker.visibleFrom(place, view)).indices;
    await worker.dispose();
    const same = shared.length === indices.length && shared.every((index, i) => index === indices[i]);
    console.log(`${points} points: ${indices.length} visible; a worker agrees: ${same}`);
    return same;
  } catch (error) {
    if (!(error instanceof HprError)) throw error;
    console.log(`${points} points: refused, ${error.code}: ${error.message}`);
    return error.code === "too-large";
  }
}

function timed<Result>(name: string, work: () => Result): Result {
  const start = performance.now();
  const result = work();
  console.log(`${name}: ${((performance.now() - start) / 1000).toFixed(2)} s`);
  return result;
}

/** Megabytes of the process and its workers, after garbage collection. */
async function resident(): Promise<number> {
  setFlagsFromString("--expose-gc");
  const collectGarbage = runInNewContext("gc") as () => void;
  // Finalizers run between two collections.
  for (let i = 0; i < 2; i++) {
    collectGarbage();
    await new Promise((next) => setTimeout(next, 50));
  }
  return process.memoryUsage().rss / 1e6;
}
