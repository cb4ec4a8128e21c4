import { expect, it } from "vitest";

import { seeded } from "../bench/generators";
import { bumpySphere, readyPackage } from "./support";

const { PointCloud, VisibilityMap, cameraFromPose } = await readyPackage();

const positions = bumpySphere(3, 20_000);
const cloud = new PointCloud(positions);
const viewpoint = [3, 1, 2];

/** The share of the hidden points that a map hides. It must hide no visible one. */
function share(found: { indices: Uint32Array }, hidden: Uint8Array): number {
  for (const index of found.indices) expect(hidden[index], `point ${index}`).toBe(0);
  return hidden.reduce((sum, byte) => sum + byte, 0) / (hidden.length - found.indices.length);
}

it("hides hidden points only, and most of them", () => {
  const options = { exponent: 3 };
  const seen = cloud.visibleFrom(viewpoint, options);
  const map = cloud.visibilityMap(viewpoint, options);
  expect(map).toBeInstanceOf(VisibilityMap);
  expect(map.viewpoint).toEqual(viewpoint);
  expect(map.origin).toEqual([0, 0, 0]);
  expect(map.data.length % 256).toBe(0);
  expect(share(seen, map.hides(positions))).toBeGreaterThan(0.8);
  // Any kind of list, and places anywhere.
  expect(map.hides([0, 0, 0, 3, 1, 2, NaN, 0, 0, Infinity, 0, 0])).toEqual(Uint8Array.of(1, 0, 0, 0));
});

it("shows what looks with a thickness show beside an outline", () => {
  // The sides of a box, which a thickness reveals. Without a wider margin, 8 % of these points are hidden.
  const random = seeded(7);
  const box = new Float64Array(90_000);
  for (let i = 0; i < 30_000; i++) {
    for (let axis = 0; axis < 3; axis++) box[3 * i + axis] = 2 * random() - 1;
    box[3 * i + ((i % 6) >> 1)] = i % 2 === 0 ? -1 : 1;
  }
  const sides = new PointCloud(box);
  for (const from of [
    [1.5, 0, 0],
    [3, 2, 1],
  ] as const) {
    const options = { looks: 3 as const, thickness: 2 * sides.spacing };
    const { indices, count } = sides.visibleFrom(from, options);
    const hidden = sides.visibilityMap(from, options).hides(box);
    expect(indices.filter((index) => hidden[index]).length).toBeLessThan(0.01 * count);
  }
  sides.dispose();
});

it("has no more cells than points", () => {
  const options = { radius: 1e9, points: 268_435_456 };
  expect(cloud.visibilityMap(viewpoint, options)).toBeInstanceOf(VisibilityMap);
});

it("refuses what has no map", () => {
  const refused = (options: object, at: ArrayLike<number> = viewpoint) => {
    try {
      cloud.visibilityMap(at, options);
    } catch (error) {
      return (error as { code: string }).code;
    }
    return "no error";
  };
  const wrong = [
    { points: 1 },
    { points: NaN },
    { towards: 1 },
    { towards: [0, 0, 1] },
    { towards: { direction: [1, 0, 0], angle: 9, aperture: 1 } },
    { towards: { direction: [1, 0, 0], angle: 0 } },
    { towards: { direction: [1, 0, 0] } },
    { radius: "opposite" },
    { looks: 3, scores: true },
    { corner: 1 },
  ];
  for (const options of wrong) expect([options, refused(options)]).toEqual([options, "option"]);
  expect(refused({ towards: { direction: [0, 0, 0], angle: 9 } })).toBe("viewpoint");
  const lens = { fx: 400, fy: 400, cx: 320, cy: 240, width: 640, height: 480 };
  for (const wrong of [{ fx: 0 }, { width: -1 }, { near: -1 }, { far: NaN }, { cx: Infinity }]) {
    const towards = { ...cameraFromPose([0, 0, 4], [0, 0, 0, 1], lens, "opengl"), ...wrong };
    expect([wrong, refused({ towards })]).toEqual([wrong, "viewpoint"]);
  }
  expect(refused({ origin: [NaN, 0, 0] })).toBe("viewpoint");
  expect(refused({}, [NaN, 0, 0])).toBe("viewpoint");
  expect(refused({ radius: 0.001 })).toBe("radius");
  const map = cloud.visibilityMap(viewpoint);
  expect(() => map.hides([1, 2])).toThrow(/multiple of 3/);
  map.dispose();
  map.dispose();
  expect(() => map.hides([1, 2, 3])).toThrow(/disposed/);
});

it("hides nothing where a cloud has no surface", () => {
  for (const given of [[], [1, 2, 3], [1, 2, 3, 1, 2, 3], [0, 0, 0, 1, 0, 0, 2, 0, 0], [0, 0, 0, 1, 0, 0, 0, 1, 0]]) {
    const small = new PointCloud(given);
    const map = small.visibilityMap([0, 0, 5]);
    expect(map.hides([...given, 9, 9, 9])).toEqual(new Uint8Array(given.length / 3 + 1));
    small.dispose();
  }
});
