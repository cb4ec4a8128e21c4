// One row for each question that can be asked of a cloud: its arguments, as a tree of plain values. The tests of arguments,
// the law of parts and the fuzzer of exports all read this table.
import * as hpr from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";

export type AnyCloud = hpr.PointCloud | WorkerPointCloud;
export type Place = readonly [number, number, number];

/** Which points of a larger cloud arguments may name, and how many indices the asked cloud has. */
export class Part {
  readonly length: number;
  readonly points: readonly number[];
  readonly #numbers: Map<number, number>;

  /** @param points the indices of the part, ascending */
  constructor(length: number, points = Array.from({ length }, (_, i) => i)) {
    [this.length, this.points] = [length, points];
    this.#numbers = new Map(points.map((index, i) => [index, i]));
  }

  /** Indices of the larger cloud as those of a cloud of the part alone. */
  own(indices: Iterable<number>): number[] {
    return [...indices].flatMap((index) => this.#numbers.get(index) ?? []);
  }

  /** What an array holds for the part: `each` numbers for each index. */
  of(values: ArrayLike<number>, each = 1): number[] {
    return this.points.flatMap((index) => Array.from({ length: each }, (_, k) => values[each * index + k]!));
  }
}

const LENS = hpr.intrinsicsFromFieldOfView(50, 32, 24);
export const CAMERAS = [
  hpr.cameraFromPose([0, 0, 5], [0, 0, 0, 1], LENS, "opengl"),
  hpr.cameraFromPose([4, 0, 0.5], [0.5, 0.5, 0.5, 0.5], LENS, "opengl"),
];
const cameras = () => CAMERAS.map((camera) => ({ ...camera, cameraToWorld: Float64Array.from(camera.cameraToWorld) }));
const image = (by: number) => ({
  data: Float32Array.from({ length: 32 * 24 }, (_, i) => by * i),
  width: 32,
  height: 24,
});
const behind = () => Float64Array.of(0.5, 0, -4);
/** Places in and around the surface of a sphere of radius 1, a part of it. Their length tells them from other arrays. */
export const PLACES = 60;
const places = () =>
  Float64Array.from({ length: PLACES }, (_, i) => [0.3, 0.3, 0.9][i % 3]! + [0.6, 0.6, 0.4][i % 3]! * Math.sin(i * i));
/** For each point of a cloud of so many points. */
const numbers = (part: Part, length: number) =>
  Float64Array.from(part.of(Array.from({ length }, (_, i) => (i % 5) / 4)));
/** Every second point. */
const measured = (part: Part, length: number) =>
  Uint32Array.from(part.own(Array.from({ length: Math.ceil(length / 2) }, (_, i) => 2 * i)));

/** The arguments of each question, the options last. Each call makes new ones. `all`: the length of the larger cloud. */
export const QUESTIONS: Record<string, (at: unknown, part: Part, all: number) => unknown[]> = {
  visibleFrom: (at) => [at, {}],
  visibleFromDirection: (at) => [at, {}],
  visibleFromAny: (at) => [[at, behind(), cameras()[1]], {}],
  visibleFromAtLeast: (at) => [2, [at, behind(), cameras()[0]], {}],
  visibleFromCamera: () => [cameras()[1], {}],
  sees: (at) => [at, places(), {}],
  coverage: (at) => [[at, behind(), cameras()[0]], {}],
  seenBy: () => [cameras(), {}],
  placeViewpoints: (at, part, all) => [[at, behind(), cameras()[1]], { weights: numbers(part, all) }],
  panorama: (at) => [at, { width: 16, height: 8, up: Float64Array.of(0, 1, 1) }],
  visibilityMap: (at) => [at, { points: 64 }],
  reconstruct: (at) => [at, {}],
  illuminate: (at) => [[at, behind()], {}],
  calibrate: (at, part, all) => [
    [
      { viewpoint: at, indices: measured(part, all) },
      { viewpoint: behind(), mask: Uint8Array.from(numbers(part, all), Number) },
    ],
    {},
  ],
  transfer: () => [cameras(), [image(1), image(2)], {}],
  autoRadius: (at) => [at, "auto", {}],
};

/** Asks by the row of a name. `more`: further options. */
export const asked = (cloud: AnyCloud, name: string, args: readonly unknown[], more: object = {}): unknown => {
  const options = args.at(-1) as object;
  const all = [
    ...args.slice(0, -1),
    Object.assign(Object.create(Reflect.getPrototypeOf(options)) as object, options, more),
  ];
  if (name === "transfer") return hpr.transfer(cloud as hpr.PointCloud, ...(all as [never, never]));
  return (cloud as unknown as Record<string, (...all: unknown[]) => unknown>)[name]!(...all);
};

/** What a class has besides questions. */
const OTHERS = ["constructor", "append", "remove", "dispose", "follow"];
const PROPERTIES = ["length", "skipped", "spacing", "noise", "surface"];

/** The methods of both kinds of clouds that no row asks, and rows that no cloud answers. */
export function strays(): string[] {
  const rows = Object.keys(QUESTIONS).filter((name) => name !== "transfer");
  return [hpr.PointCloud, WorkerPointCloud].flatMap(({ prototype }) => {
    const own = Object.getOwnPropertyNames(prototype);
    const known = [...rows, ...OTHERS, ...PROPERTIES];
    return [...own.filter((name) => !known.includes(name)), ...rows.filter((name) => !own.includes(name))];
  });
}
