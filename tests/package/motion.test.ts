import { describe, expect, it } from "vitest";

import { bumpySphere, bunny, randomNumbers, readyPackage } from "./support";

// Two instances of the wasm. In one of them each view starts from the last view. The other
// sees only new clouds.
const moving = await readyPackage();
const cold = await readyPackage();

type Cloud = InstanceType<typeof moving.PointCloud>;

/** Each view of `cloud` equals the view of a new cloud built from `points`. */
function expectAsCold(cloud: Cloud, points: Float32Array, removed: number[], viewpoint: number[], options = {}) {
  const fresh = new cold.PointCloud(points);
  fresh.remove(removed);
  const expected = fresh.visibleFrom(viewpoint, options);
  fresh.dispose();
  const answer = cloud.visibleFrom(viewpoint, options);
  expect(answer.indices).toEqual(expected.indices);
  expect([answer.radius, answer.exponent]).toEqual([expected.radius, expected.exponent]);
}

/** Viewpoints that move by small and large steps. */
function walk(seed: number) {
  const random = randomNumbers(seed);
  let viewpoint = [0.2, 0.3, 2.5];
  return () => {
    const step = 10 ** (-9 * random());
    viewpoint = viewpoint.map((x) => x * 0.99 + step * (random() - 0.5));
    return viewpoint;
  };
}

describe("views that start from the last one", () => {
  it("are compared with those of another instance", () => {
    expect(cold.PointCloud).not.toBe(moving.PointCloud);
  });

  it("equal cold views between changes of the cloud", () => {
    const points = bumpySphere(1, 5000);
    const cloud = new moving.PointCloud(points.subarray(0, 9000));
    const next = walk(1);
    const removed: number[] = [];
    for (let step = 0, length = 3000; step < 60; step++) {
      if (step % 6 === 3) {
        cloud.append(points.subarray(3 * length, 3 * length + 300));
        length += 100;
      }
      if (step % 6 === 5) {
        const gone = [7 * step, 7 * step + 1, length - 1];
        cloud.remove(gone);
        removed.push(...gone);
      }
      expectAsCold(cloud, points.subarray(0, 3 * length), removed, next());
    }
    cloud.dispose();
  });

  it("equal cold views if two clouds take turns and are disposed of", () => {
    const all = [bumpySphere(2, 3000), bunny()];
    const next = walk(2);
    let clouds = all.map((points) => new moving.PointCloud(points));
    for (let step = 0; step < 60; step++) {
      const one = step % 3 === 0 ? 0 : 1;
      expectAsCold(clouds[one]!, all[one]!, [], next());
      if (step % 20 === 19) {
        // The new cloud takes over the freed number.
        for (const cloud of clouds) cloud.dispose();
        all.reverse();
        clouds = all.map((points) => new moving.PointCloud(points));
      }
    }
  });

  it("equal cold views after refusals", () => {
    const points = bumpySphere(3, 3000);
    const cloud = new moving.PointCloud(points);
    const next = walk(3);
    for (const options of [{ radius: 0.1 }, { exponent: -1 }, { radius: NaN }, { exponent: 400 }]) {
      expectAsCold(cloud, points, [], next());
      expect(() => cloud.visibleFrom(next(), options)).toThrow();
      expectAsCold(cloud, points, [], next());
      expect(() => cloud.visibleFrom([NaN, 0, 0])).toThrow();
      expectAsCold(cloud, points, [], next(), { exponent: 2 });
    }
    cloud.dispose();
  });

  it.each([1, 2, 3])("equal cold views with %d workers", async (workers) => {
    const points = bumpySphere(4, 4000);
    const cloud = await moving.WorkerPointCloud.create(points, { workers });
    const still = new cold.PointCloud(points);
    const next = walk(4);
    for (let step = 0; step < 40; step++) {
      const viewpoint = next();
      if (step % 10 === 5) {
        await cloud.remove([step]);
        still.remove([step]);
      }
      const answer = await cloud.visibleFrom(viewpoint);
      expect(answer.indices).toEqual(still.visibleFrom(viewpoint).indices);
    }
    await cloud.dispose();
  });
});
