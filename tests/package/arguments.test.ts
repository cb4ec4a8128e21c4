// Arguments as users hold them: vectors of classes, records without a prototype, signals with a reason.
import { Vector3 } from "three";
import { afterAll, expect, it } from "vitest";

import { bumpySphere, problemOf, readyPackage } from "./support";

const hpr = await readyPackage();
const { HprError, PointCloud, WorkerPointCloud } = hpr;
const { colmapVis } = await import("hidden-point-removal/files");

const positions = bumpySphere(3, 3000);
const cloud = new PointCloud(positions);
const remote = await WorkerPointCloud.create(positions, { workers: 2 });
afterAll(() => remote.dispose());

/** A vector of a library whose `length` is a method. */
class Vector {
  readonly x: number;
  readonly y: number;
  readonly z: number;

  constructor(x: number, y: number, z: number) {
    [this.x, this.y, this.z] = [x, y, z];
  }

  length(): number {
    return Math.hypot(this.x, this.y, this.z);
  }
}

const far = [0.5, 1, 5] as const;
const CAMERA = hpr.cameraFromPose([0, 0, 5], [0, 0, 0, 1], hpr.intrinsicsFromFieldOfView(50, 64, 48), "opengl");

const IMAGE = { data: Float32Array.from({ length: 64 * 48 }, (_, i) => i), width: 64, height: 48 };

type AnyCloud = typeof cloud | typeof remote;
type Place = { x: number; y: number; z: number } | readonly number[];

/** Every question, with a place and further options. */
const QUESTIONS: Record<string, (cloud: AnyCloud, at: Place, more: object) => unknown> = {
  visibleFrom: (one, at, more) => one.visibleFrom(at, more),
  visibleFromDirection: (one, at, more) => one.visibleFromDirection(at as never, more),
  visibleFromAny: (one, at, more) => one.visibleFromAny([at], more),
  visibleFromAtLeast: (one, at, more) => one.visibleFromAtLeast(1, [at], more),
  visibleFromCamera: (one, _, more) => one.visibleFromCamera(CAMERA, more),
  sees: (one, at, more) => one.sees(at, [9, 9, 9, 0, 0, 2], more),
  coverage: (one, at, more) => one.coverage([at], more),
  seenBy: (one, _, more) => one.seenBy([CAMERA], more),
  placeViewpoints: (one, at, more) => one.placeViewpoints([at, [0, 0, -5]], more),
  panorama: (one, at, more) => one.panorama(at, { width: 8, height: 4, ...more }),
  visibilityMap: async (one, at, more) => (await one.visibilityMap(at, more)).hides(positions),
  reconstruct: (one, at, more) => one.reconstruct(at, more),
  illuminate: (one, at, more) => one.illuminate([at], more),
  calibrate: (one, at, more) => one.calibrate([{ viewpoint: at, indices: [0, 1, 2] }], more),
  transfer: (one, _, more) => hpr.transfer(one as never, [CAMERA], [IMAGE], more),
};

it.each(Object.keys(QUESTIONS))("%s takes vectors of any class, and records without a prototype", async (name) => {
  const ask = QUESTIONS[name]!;
  const bare = Object.assign(Object.create(null) as object, { x: far[0], y: far[1], z: far[2] }) as Vector;
  for (const of of [cloud, remote]) {
    const expected = await ask(of, far, {});
    for (const at of [new Vector3(...far), new Vector(...far), bare, Float64Array.from(far)]) {
      expect(await ask(of, at as Vector, Object.create(null) as object)).toEqual(expected);
    }
  }
});

it.each(Object.keys(QUESTIONS))("%s is not changed by what somebody added to Object.prototype", async (name) => {
  const ask = QUESTIONS[name]!;
  const expected = await ask(cloud, far, {});
  const added = { looks: 2, exponent: 1, mask: new Uint8Array(3000), convention: "opencv", scores: true, length: 7 };
  const prototype = Object.prototype as unknown as Record<string, unknown>;
  Object.assign(prototype, added);
  try {
    const found = await ask(cloud, far, {});
    for (const key of Object.keys(added)) Reflect.deleteProperty(prototype, key);
    expect(found).toEqual(expected);
  } finally {
    for (const key of Object.keys(added)) Reflect.deleteProperty(prototype, key);
  }
});

it.each(Object.keys(QUESTIONS))("%s in a worker rejects with the reason of its signal", async (name) => {
  const reason = new TypeError("the user went on");
  const controller = new AbortController();
  const asked = problemOf(() => QUESTIONS[name]!(remote, far, { signal: controller.signal }));
  controller.abort(reason);
  expect(await asked).toBe(reason);
  expect(await problemOf(() => QUESTIONS[name]!(remote, far, { signal: AbortSignal.abort(reason) }))).toBe(reason);
});

it.each<[string, () => unknown]>([
  ["transfer", () => hpr.transfer(undefined as never, [], [])],
  ["transfer", () => hpr.transfer(cloud, [], null as never)],
  ["transfer", () => hpr.transfer(cloud, [CAMERA], [{ data: IMAGE.data, width: 64n, height: 48 }] as never)],
  ["calibrate", () => cloud.calibrate([null] as never)],
  ["colmapVis", () => colmapVis(null as never)],
  ["colmapVis", () => colmapVis({ offsets: { at: () => 0, length: 1 }, cameras: [] } as never)],
  ["orientNormals", () => hpr.orientNormals(new Float32Array(3), null as never)],
  ["intrinsicsFromFieldOfView", () => hpr.intrinsicsFromFieldOfView(1n as never, 2, 2)],
  ["intrinsicsFromFieldOfView", () => hpr.intrinsicsFromFieldOfView(50, 2n as never, 2)],
  ["cameraFromPose", () => hpr.cameraFromPose({ length: 1e15 }, [0, 0, 0, 1], CAMERA)],
  ["cameraFromThree", () => hpr.cameraFromThree({ isPerspectiveCamera: true } as never, 4, 4)],
])("%s refuses junk with an HprError", async (_, call) => {
  expect(await problemOf(call)).toBeInstanceOf(HprError);
});
