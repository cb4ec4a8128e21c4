import { expect, it } from "vitest";

import { bumpySphere, readyPackage } from "./support";

const { PointCloud, hiddenPointRemoval } = await readyPackage();

type Cloud = InstanceType<typeof PointCloud>;

const positions = bumpySphere(3, 30_000);
const from = [0.3, 0.8, 2.5];

function isPart(part: Uint32Array, whole: Uint32Array): boolean {
  const all = new Set(whole);
  return part.every((index) => all.has(index));
}

it("an exact answer does not go on from the draft of a cloud that has changed since", () => {
  const added = Float64Array.from(positions.subarray(0, 3000), (x) => 1.01 * x);
  // With a radius of its own, the flip stays the same.
  const options = { radius: 40 };
  const { indices } = hiddenPointRemoval(positions, from, options);
  const changes = [
    (cloud: Cloud) => {
      cloud.append(added);
    },
    (cloud: Cloud) => {
      cloud.remove(indices);
    },
  ];
  for (const change of changes) {
    const [cloud, fresh] = [new PointCloud(positions), new PointCloud(positions)];
    change(fresh);
    const expected = fresh.visibleFrom(from, options);
    const draft = cloud.visibleFrom(from, { ...options, draft: true });
    change(cloud);
    const exact = cloud.visibleFrom(from, options);
    expect(exact.indices).toEqual(expected.indices);
    expect(isPart(exact.indices, draft.indices)).toBe(false);
    cloud.dispose();
    fresh.dispose();
  }
});

it("an exact answer does not go on from the draft of another cloud", () => {
  const mirrored = positions.map((x, i) => (i % 3 === 2 ? -x : x));
  const [cloud, other] = [new PointCloud(positions), new PointCloud(mirrored)];
  const options = { radius: 40 };
  const draft = other.visibleFrom(from, { ...options, draft: true });
  const exact = cloud.visibleFrom(from, options);
  expect(exact.indices).toEqual(hiddenPointRemoval(positions, from, options).indices);
  expect(isPart(exact.indices, draft.indices)).toBe(false);
  cloud.dispose();
  other.dispose();
});

it("drafts and samples of the wrong type or size are refused", () => {
  const cloud = new PointCloud(positions);
  for (const options of [{ draft: 1 }, { sample: 0 }, { sample: 2.5 }, { sample: "10" }, { sample: Infinity }]) {
    expect(() => cloud.visibleFrom(from, options as object)).toThrow(expect.objectContaining({ code: "option" }));
  }
  const four = new PointCloud(Float64Array.from(positions.subarray(0, 400)), { dimension: 4 });
  for (const options of [{ draft: true }, { sample: 5 }]) {
    expect(() => four.visibleFrom([1, 2, 3, 4], options)).toThrow(/dimension 3, not 4/);
  }
  cloud.dispose();
  four.dispose();
});
