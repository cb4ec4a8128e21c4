import { expect, it } from "vitest";

import { bumpySphere, expectRefusal, randomNumbers, readyPackage } from "./support";

const { PointCloud, WorkerPointCloud } = await readyPackage();

const positions = bumpySphere(5, 3000);
const count = positions.length / 3;
const random = randomNumbers(7);
const places = Array.from({ length: 10 }, () => [0, 0, 0].map(() => 4 * random() - 2));
const weights = Array.from({ length: count }, () => Math.floor(4 * random()) * 0.1);

it("coverage counts the views", () => {
  const cloud = new PointCloud(positions);
  for (const options of [{}, { exponent: 3 }, { looks: 2 as const }, { within: { distance: 2 } }]) {
    const expected = new Uint32Array(count);
    for (const place of places) for (const index of cloud.visibleFrom(place, options).indices) expected[index]! += 1;
    const heard: number[] = [];
    const onProgress = (share: number) => heard.push(share);
    expect(cloud.coverage(places, { ...options, onProgress })).toEqual(expected);
    expect(heard).toEqual(places.map((_, i) => (i + 1) / places.length));
  }
  expect(cloud.coverage([])).toEqual(new Uint32Array(count));
  cloud.dispose();
});

it("a survey can be given up, and a refusal ends it", async () => {
  const remote = await WorkerPointCloud.create(positions, { workers: 2 });
  const controller = new AbortController();
  let heard = 0;
  const onProgress = () => {
    heard += 1;
    if (heard === 3) controller.abort();
  };
  const many = Array.from({ length: 300 }, (_, i) => [3, i / 100, 0]);
  await expect(remote.coverage(many, { signal: controller.signal, onProgress })).rejects.toMatchObject({
    name: "AbortError",
  });
  const refused = remote.coverage([...places, [1e9, 0, 0]], { radius: 8 });
  await expect(refused).rejects.toMatchObject({ code: "radius" });
  expect((await remote.coverage(places)).length).toBe(count);
  expect(heard).toBeLessThan(20);
  await remote.dispose();
});

it("questions that make no sense are refused", async () => {
  const cloud = new PointCloud(positions);
  const bad: [() => unknown, string, RegExp][] = [
    [() => cloud.coverage(5 as never), "viewpoint", /viewpoints must be an array/],
    [() => cloud.coverage([[1, 2]]), "viewpoint", /viewpoints\[0\]/],
    [() => cloud.placeViewpoints([places[0]!, [1, 2, NaN]]), "viewpoint", /viewpoint candidates\[1\] must be finite/],
    [
      () => cloud.coverage([...places, [1e9, 0, 0]], { radius: 8 }),
      "radius",
      new RegExp(`viewpoint ${places.length}: radius 8`),
    ],
    [() => cloud.coverage(places, { onProgress: () => cloud.append([]) }), "option", /must not change the cloud/],
    [() => cloud.placeViewpoints(places, { onProgress: () => cloud.remove([]) }), "option", /must not change/],
    [() => cloud.coverage(places, { looks: 3, scores: true }), "option", /scores cannot be combined with coverage/],
    [() => cloud.placeViewpoints(places, { looks: 2, scores: true }), "option", /scores cannot be combined/],
    [() => cloud.placeViewpoints(places, { count: 0 }), "option", /count must be an integer from 1/],
    [
      () => cloud.placeViewpoints(places, { share: 1.5 }),
      "option",
      /share must be a finite number, above 0 and at most 1, got 1.5/,
    ],
    [() => cloud.placeViewpoints(places, { weights: [1] }), "option", /one number for each of 3000 indices, got 1/],
    [() => cloud.placeViewpoints(places, { weights: weights.map(() => -1) }), "option", /weights\[0\]/],
    [() => cloud.coverage(places, { onProgress: 5 as never }), "option", /onProgress must be a function/],
  ];
  for (const [ask, code, message] of bad) {
    await expectRefusal(code, message, ask);
  }
  cloud.dispose();
});
