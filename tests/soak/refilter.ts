// Runs like a page that is open all day: viewpoints move through several clouds in workers, and points come and go.
// Memory must not grow. Each checked answer must equal the answer of a new cloud in a new instance.
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import type { Visibility } from "hidden-point-removal";
import { bumpySurface, seeded, terrainUtm, unevenSurface } from "../bench/generators.js";

/** One cloud, and its use. */
interface Subject {
  name: string;
  positions: Float32Array | Float64Array;
  /** The options that choose its workers. */
  placement: { workers?: number; shared?: boolean };
  /** The viewpoint stays near this middle: on each axis it is at most `reach` away. */
  middle: readonly [number, number, number];
  reach: number;
  /** Of every 40 views, this many are views of this cloud. */
  share: number;
  /** The number of views between two changes of the points. A change removes some points and appends others. */
  changes?: number;
}

const SUBJECTS: readonly Subject[] = [
  {
    name: "bumpy surface, 200,000 points, default workers",
    positions: bumpySurface(200_000, 1),
    placement: {},
    middle: [0, 0, 0],
    reach: 3,
    share: 1,
  },
  {
    name: "uneven surface, 5,000 points, 2 workers",
    positions: unevenSurface(5_000, 2),
    placement: { workers: 2 },
    middle: [0, 0, 0],
    reach: 2,
    share: 9,
  },
  {
    name: "hills, 3,000 points, 1 worker",
    positions: terrainUtm(3_000, 3),
    placement: { workers: 1 },
    middle: [400_500, 5_000_500, 100],
    reach: 400,
    share: 10,
  },
  {
    name: "bumpy surface, 2,000 points, shared worker",
    positions: bumpySurface(2_000, 4),
    placement: { shared: true },
    middle: [0, 0, 0],
    reach: 2,
    share: 10,
  },
  {
    name: "bumpy surface that changes, 1,000 points, shared worker",
    positions: bumpySurface(1_000, 5),
    placement: { shared: true },
    middle: [0, 0, 0],
    reach: 2,
    share: 10,
    changes: 50,
  },
];

/** The state after this many views. Seconds and counts are from the start of the run. */
export interface Row {
  views: number;
  seconds: number;
  checked: number;
  wrong: number;
  /** Megabytes after garbage collection. */
  process: number;
  objects: number;
  buffers: number;
}

export interface Soak {
  rows: Row[];
  clouds: { name: string; views: number; visible: number }[];
  wrong: number;
  /** The growth of the process from the first row to the last, as a share of its size in the first row. */
  growth: number;
}

/** Asks `count` views. The clouds take turns. One view in 100 is compared with a new cloud's answer. */
export async function soak(count: number, seed = 20261122, tell: (row: Row) => void = () => undefined): Promise<Soak> {
  const random = seeded(seed);
  const walkers = await Promise.all(SUBJECTS.map((subject) => Walker.start(subject, random)));
  const turns = walkers.flatMap((walker) => Array<Walker>(walker.subject.share).fill(walker));
  const start = performance.now();
  const rows: Row[] = [];
  let [checked, wrong] = [0, 0];
  for (let view = 1; view <= count; view++) {
    const walker = turns[view % turns.length]!;
    await walker.step();
    if (view % 100 === 0) {
      // The clouds are checked in turn.
      checked += 1;
      wrong += (await walkers[(view / 100) % walkers.length]!.isRight()) ? 0 : 1;
    }
    if (view % Math.ceil(count / 20) === 0 || view === count) {
      const row = { views: view, seconds: (performance.now() - start) / 1000, checked, wrong, ...(await memory()) };
      rows.push(row);
      tell(row);
    }
  }
  const clouds = walkers.map(({ subject, views, visible }) => ({
    name: subject.name,
    views,
    visible: visible / views,
  }));
  await Promise.all(walkers.map((walker) => walker.end()));
  return { rows, clouds, wrong, growth: rows.at(-1)!.process / rows[0]!.process - 1 };
}

/** A viewpoint that moves through a cloud, mostly by small steps. */
class Walker {
  readonly subject: Subject;
  views = 0;
  visible = 0;
  readonly #cloud: WorkerPointCloud;
  readonly #random: () => number;
  #place: [number, number, number];
  /** All positions that the cloud ever got. `#removed` holds the indices of the removed points. */
  #given: number[] | undefined;
  readonly #removed = new Set<number>();

  private constructor(subject: Subject, cloud: WorkerPointCloud, random: () => number) {
    this.subject = subject;
    this.#cloud = cloud;
    this.#random = random;
    const [x, y, z] = subject.middle;
    this.#place = [x, y, z + 0.8 * subject.reach];
    this.#given = subject.changes === undefined ? undefined : [...subject.positions];
  }

  static async start(subject: Subject, random: () => number): Promise<Walker> {
    return new Walker(subject, await WorkerPointCloud.create(subject.positions, subject.placement), random);
  }

  async step(): Promise<void> {
    this.#move();
    this.views += 1;
    const { changes } = this.subject;
    if (changes !== undefined && this.views % changes === 0) {
      await this.#change();
    }
    const answer = await this.#ask();
    this.visible += answer.count;
    // The memory of every second answer is given back by hand. The rest is left to the garbage collector.
    if (this.views % 2 === 0) {
      this.#cloud.recycle(answer);
    }
  }

  /** Asks a new cloud of the present points, in an instance of its own, and compares the answers. */
  async isRight(): Promise<boolean> {
    const given = this.#given ?? this.subject.positions;
    const kept = Array.from({ length: given.length / 3 }, (_, i) => i).filter((i) => !this.#removed.has(i));
    const points = kept.flatMap((i) => [given[3 * i]!, given[3 * i + 1]!, given[3 * i + 2]!]);
    const cold = await WorkerPointCloud.create(points, { workers: 1 });
    const expected = await cold.visibleFrom(this.#place);
    await cold.dispose();
    const answer = await this.#ask();
    return (
      answer.radius === expected.radius &&
      answer.count === expected.count &&
      answer.indices.every((index, i) => index === kept[expected.indices[i]!])
    );
  }

  async end(): Promise<void> {
    await this.#cloud.dispose();
  }

  #ask(): Promise<Visibility> {
    return this.#cloud.visibleFrom(this.#place);
  }

  /** Moves the viewpoint by one step. One step in 50 is a jump to any place within reach. */
  #move(): void {
    const { middle, reach } = this.subject;
    const jump = this.#random() < 0.02;
    const size = reach * (jump ? 2 : 0.02);
    this.#place = this.#place.map((x, axis) => {
      const from = jump ? middle[axis]! : x;
      const to = from + size * (this.#random() - 0.5);
      // A step beyond the reach goes to the mirror image of the place, on the other side of the middle.
      return Math.abs(to - middle[axis]!) > reach ? 2 * middle[axis]! - from : to;
    }) as [number, number, number];
  }

  /** Removes and appends equally many points, so that the cloud keeps its size. No index is used twice. */
  async #change(): Promise<void> {
    const given = this.#given!;
    const more = Array.from({ length: 60 }, () => 2 * this.#random() - 1);
    const gone: number[] = [];
    for (let index = Math.floor((this.#random() * given.length) / 3); gone.length < 20; index++) {
      const at = index % (given.length / 3);
      if (!this.#removed.has(at)) {
        gone.push(at);
        this.#removed.add(at);
      }
    }
    given.push(...more);
    await Promise.all([this.#cloud.remove(gone), this.#cloud.append(more)]);
  }
}

/** The memory of the process, including its workers. */
async function memory(): Promise<Pick<Row, "process" | "objects" | "buffers">> {
  setFlagsFromString("--expose-gc");
  const collectGarbage = runInNewContext("gc") as () => void;
  // Finalizers run between two collections.
  for (let i = 0; i < 2; i++) {
    collectGarbage();
    await new Promise((next) => setTimeout(next, 50));
  }
  const { rss, heapUsed, arrayBuffers } = process.memoryUsage();
  const [resident, objects, buffers] = [rss, heapUsed, arrayBuffers].map((bytes) => bytes / 1e6) as [
    number,
    number,
    number,
  ];
  return { process: resident, objects, buffers };
}

/** The results, as tables. */
export function report({ rows, clouds, growth, wrong }: Soak, lines: readonly string[]): string {
  const number = (x: number, digits = 0) =>
    x.toLocaleString("en-US", { minimumFractionDigits: digits, maximumFractionDigits: digits });
  const [first, last] = [rows[0]!, rows.at(-1)!];
  return [
    "# Re-filters all day",
    "",
    ...lines.map((line) => `- ${line}`),
    "",
    "| cloud | views | visible on average |",
    "|---|---:|---:|",
    ...clouds.map(({ name, views, visible }) => `| ${name} | ${number(views)} | ${number(visible)} |`),
    "",
    `${number(last.views)} views in ${number(last.seconds)} s. ${number(last.checked)} answers were compared with those of a new`,
    `cloud in a new instance: ${number(wrong)} wrong. The process grew by ${number(100 * growth, 1)} % from the first row to the last`,
    `(${number(first.process)} to ${number(last.process)} MB). Megabytes after garbage collection; the process includes its workers.`,
    "",
    "| views | seconds | compared | wrong | process MB | objects MB | buffers MB |",
    "|---:|---:|---:|---:|---:|---:|---:|",
    ...rows.map(
      (row) =>
        `| ${number(row.views)} | ${number(row.seconds)} | ${number(row.checked)} | ${number(row.wrong)} | ` +
        `${number(row.process)} | ${number(row.objects, 1)} | ${number(row.buffers, 1)} |`,
    ),
    "",
  ].join("\n");
}
