import { expect, it } from "vitest";

import { bumpySphere, readyPackage } from "./support";

const { PointCloud, WorkerPointCloud, hiddenPointRemoval } = await readyPackage();

type Cloud = InstanceType<typeof PointCloud>;

const positions = bumpySphere(3, 30_000);
const from = [0.3, 0.8, 2.5];

function isPart(part: Uint32Array, whole: Uint32Array): boolean {
  const all = new Set(whole);
  return part.every((index) => all.has(index));
}

it("drafts hold all that is visible, with the same radius and inversion", () => {
  const cloud = new PointCloud(positions);
  const choices = [{}, { exponent: 2 }, { inversion: { exponential: "auto" as const } }, { exponent: 3, vote: 5 }];
  for (const options of choices) {
    const draft = cloud.visibleFrom(from, { ...options, draft: true });
    const exact = cloud.visibleFrom(from, options);
    const { radius, exponent, evaluations, inversion } = exact;
    expect(draft).toMatchObject({ radius, exponent, evaluations, inversion, exact: false });
    expect(exact.exact).toBe(true);
    expect(isPart(exact.indices, draft.indices)).toBe(true);
    expect(draft.count).toBeLessThan(cloud.length);
    // The answer does not depend on earlier questions.
    expect(cloud.visibleFrom(from, { ...options, draft: true }).indices).toEqual(draft.indices);
    expect(hiddenPointRemoval(positions, from, options).indices).toEqual(exact.indices);
  }
  cloud.dispose();
});

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

it("drafts are had from several viewpoints and along a direction", () => {
  const cloud = new PointCloud(positions);
  const places = [from, [0.4, 0.8, 2.5]];
  const pairs = [true, false].map((draft) => [
    cloud.visibleFromDirection(from, { draft }),
    cloud.visibleFromAny(places, { draft }),
    cloud.visibleFromAtLeast(2, places, { draft }),
  ]);
  pairs[0]!.forEach((draft, i) => {
    const exact = pairs[1]![i]!;
    expect([draft.exact, exact.exact]).toEqual([false, true]);
    expect(draft.radius).toBe(exact.radius);
    expect(isPart(exact.indices, draft.indices)).toBe(true);
  });
  cloud.dispose();
});

it("there is no draft of a search, a mesh or light", () => {
  const cloud = new PointCloud(positions);
  const asks = [
    () => cloud.visibleFrom(from, { draft: true, radius: "search" }),
    () => cloud.visibleFrom(from, { draft: true, radius: "opposite" }),
    () => cloud.reconstruct(from, { draft: true }),
    () => cloud.illuminate([from], { draft: true }),
  ];
  for (const ask of asks) {
    expect(ask).toThrow(expect.objectContaining({ code: "option" }));
    expect(ask).toThrow(/draft cannot be combined with/);
  }
  cloud.dispose();
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

it("drafts and samples of clouds in a plane are had", () => {
  const flat = new PointCloud(positions.subarray(0, 2000), { dimension: 2 });
  const exact = flat.visibleFrom([3, 4]);
  const draft = flat.visibleFrom([3, 4], { draft: true });
  expect(isPart(exact.indices, draft.indices)).toBe(true);
  expect(flat.visibleFrom([3, 4], { sample: 50, exponent: 9 }).count).toBeLessThanOrEqual(50);
  flat.dispose();
});

it("a sample answers as a cloud of its points, until the cloud changes", () => {
  const cloud = new PointCloud(positions);
  // With this exponent, all points that take part are visible from the middle.
  const taken = (sample: number) => cloud.visibleFrom([0, 0, 0], { sample, exponent: 12 });
  const sampled = taken(2000);
  expect(sampled.exact).toBe(false);
  expect(sampled.count).toBe(2000);
  expect(isPart(taken(1234).indices, sampled.indices)).toBe(true);
  const places = Array.from(sampled.indices, (i) => positions.subarray(3 * i, 3 * i + 3));
  const alone = new PointCloud(places.flatMap((place) => Array.from(place)));
  const expected = alone.visibleFrom(from);
  const seen = cloud.visibleFrom(from, { sample: 2000 });
  expect(Array.from(seen.indices)).toEqual(Array.from(expected.indices, (i) => sampled.indices[i]));
  expect(seen.radius).toBe(expected.radius);
  cloud.remove(sampled.indices);
  expect(taken(2000).indices.some((i) => sampled.indices.includes(i))).toBe(false);
  alone.dispose();
  cloud.dispose();
});

it("a sample counts distinct places, and takes all points at each of them", () => {
  const [part, count] = [positions.subarray(0, 3 * 400), 100];
  const once = new PointCloud(part);
  // The point i stands there i % 4 + 1 times.
  const owners = Array.from({ length: 400 }, (_, i) => Array<number>(1 + (i % 4)).fill(i)).flat();
  const often = new PointCloud(Float32Array.from(owners.flatMap((i) => [...part.subarray(3 * i, 3 * i + 3)])));
  for (const exponent of [12, 1]) {
    const options = { sample: count, exponent };
    const seen = new Set(once.visibleFrom([0, 0, 0], options).indices);
    const expected = owners.flatMap((owner, index) => (seen.has(owner) ? [index] : []));
    expect([...often.visibleFrom([0, 0, 0], options).indices]).toEqual(expected);
    // With the larger exponent, all that take part are visible from the middle.
    expect(exponent < 12 || (seen.size === count && expected.length > count)).toBe(true);
  }
  once.dispose();
  often.dispose();
});

it("workers give the same drafts and samples", async () => {
  const cloud = new PointCloud(positions);
  for (const workers of [1, 2]) {
    const remote = await WorkerPointCloud.create(positions, { workers });
    for (const options of [{ draft: true }, {}, { sample: 5000 }, { draft: true, vote: 3 }]) {
      const [answer, expected] = [await remote.visibleFrom(from, options), cloud.visibleFrom(from, options)];
      expect(answer.indices).toEqual(expected.indices);
      expect([answer.radius, answer.exact]).toEqual([expected.radius, expected.exact]);
    }
    await remote.dispose();
  }
  cloud.dispose();
});
