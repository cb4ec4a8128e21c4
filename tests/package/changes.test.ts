import { describe, expect, it } from "vitest";

import { bumpySphere, bunny, pointsAt, randomNumbers, readyPackage } from "./support";

const { PointCloud } = await readyPackage();

const sphere = bumpySphere(1, 3000);
const viewpoints = [
  [0, 0, 5],
  [3, -2, 1],
  [0.1, 0.2, -0.1],
];

/** Every answer equals the answer of a new cloud of the `present` points. */
function expectAsFresh(cloud: InstanceType<typeof PointCloud>, points: Float32Array, present: number[]) {
  const fresh = new PointCloud(pointsAt(points, present));
  for (const viewpoint of viewpoints) {
    expect(cloud.autoRadius(viewpoint)).toEqual(fresh.autoRadius(viewpoint));
    const { indices, radius } = cloud.visibleFrom(viewpoint);
    const expected = fresh.visibleFrom(viewpoint);
    expect([...indices]).toEqual([...expected.indices].map((i) => present[i]));
    expect(radius).toBe(expected.radius);
  }
  fresh.dispose();
}

describe("a cloud after append() and remove()", () => {
  it.each([
    ["a bumpy sphere", sphere],
    ["the bunny", bunny()],
  ])("answers as a new cloud of the same points: %s", (_, points) => {
    const random = randomNumbers(7);
    const total = points.length / 3;
    let length = Math.floor(total / 3);
    const cloud = new PointCloud(points.subarray(0, 3 * length));
    let present = Array.from({ length }, (_, i) => i);
    for (let step = 0; length < total; step++) {
      const more = Math.min(total - length, Math.floor((random() * total) / 4) + 1);
      const added = points.subarray(3 * length, 3 * (length + more));
      cloud.append([added, Float64Array.from(added), [...added]][step % 3]!);
      present.push(...Array.from({ length: more }, (_, i) => length + i));
      length += more;
      expect(cloud).toHaveLength(length);
      const gone = new Set(present.filter(() => random() < 0.1));
      cloud.remove([...gone, ...gone]);
      present = present.filter((i) => !gone.has(i));
      expectAsFresh(cloud, points, present);
      expect(cloud).toHaveLength(length);
      expect(cloud.visibleFrom([0, 0, 5]).mask()).toHaveLength(length);
    }
  });

  it("takes indices in any list of integers, and accepts the indices of removed points again", () => {
    const cloud = new PointCloud([0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 1, 1, 1]);
    const seen = () => [...cloud.visibleFrom([0, 0, 5]).indices];
    const removals: [ArrayLike<number>, number[]][] = [
      [[], [3, 4]],
      [
        [3, 3],
        [2, 4],
      ],
      [new Uint32Array([3, 4]), [2]],
      [new Float64Array([2]), [1]],
      [{ length: 1, 0: 1 }, [0]],
      [new Uint8Array([0, 1, 2, 3, 4]), []],
    ];
    for (const [indices, left] of removals) {
      cloud.remove(indices);
      expect(seen()).toEqual(left);
      expect(cloud).toHaveLength(5);
    }
    cloud.append([0, 0, 1]);
    expect(seen()).toEqual([5]);
  });

  it("leaves answers already given as they are", () => {
    const cloud = new PointCloud(sphere);
    const before = cloud.visibleFrom([0, 0, 5]);
    const copy = [...before.indices];
    cloud.append(sphere);
    cloud.remove(before.indices);
    expect([...before.indices]).toEqual(copy);
    expect(before.mask()).toHaveLength(3000);
  });
});
