import { describe, expect, it } from "vitest";

import { bumpySphere, readyPackage } from "./support";

const { PointCloud } = await readyPackage();

const sphere = bumpySphere(1, 3000);

describe("a cloud after append() and remove()", () => {
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
