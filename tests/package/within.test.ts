import { expect, it } from "vitest";

import { bumpySphere, pointsAt, readyPackage } from "./support";

const { PointCloud, WorkerPointCloud, hiddenPointRemoval } = await readyPackage();

const positions = bumpySphere(5, 6000);
const count = positions.length / 3;
const from = [0.3, 0.8, 2.5];
const box = [
  [-0.7, -2, -0.3],
  [2, 0.9, 2],
] as const;
const mask = Uint8Array.from({ length: count }, (_, i) => (i % 3 === 0 ? 0 : i % 256));

/** The indices that take part, by the definition. */
function chosen(within: { distance?: number; box?: typeof box; mask?: Uint8Array }): number[] {
  return Array.from({ length: count }, (_, i) => i).filter((i) => {
    const place = [...positions.subarray(3 * i, 3 * i + 3)];
    const [x, y, z] = place.map((coordinate, axis) => coordinate - from[axis]!) as [number, number, number];
    const isNear = within.distance === undefined || Math.sqrt(x * x + y * y + z * z) <= within.distance;
    const [min, max] = within.box ?? [undefined, undefined];
    const isInside = min === undefined || place.every((at, axis) => min[axis]! <= at && at <= max[axis]!);
    return isNear && isInside && (within.mask === undefined || within.mask[i] !== 0);
  });
}

const choices = [{ distance: 2 }, { box }, { mask }, { distance: 2.2, box, mask }, {}];

it("the answer is that of a cloud of the chosen points alone", () => {
  const cloud = new PointCloud(positions);
  for (const within of choices) {
    const indices = chosen(within);
    const alone = new PointCloud(pointsAt(positions, indices));
    for (const options of [{}, { exponent: 3 }, { looks: 3 as const, scores: true }, { vote: 5 }, { sample: 500 }]) {
      const seen = cloud.visibleFrom(from, { ...options, within });
      const expected = alone.visibleFrom(from, options);
      expect(Array.from(seen.indices)).toEqual(Array.from(expected.indices, (i) => indices[i]));
      expect([seen.radius, seen.exact]).toEqual([expected.radius, expected.exact]);
      expect(seen.mask().length).toBe(count);
      if (expected.scores !== undefined) {
        expect(indices.map((i) => seen.scores![i])).toEqual(Array.from(expected.scores));
      }
    }
    const mesh = cloud.reconstruct(from, { within }).triangles;
    expect(mesh).toEqual(alone.reconstruct(from).triangles.map((i) => indices[i]!));
    alone.dispose();
  }
  cloud.dispose();
});

it("choices change from view to view, and the hull of one is no start for another", () => {
  const cloud = new PointCloud(positions);
  const masks = [0, 1, 2].map((rest) => Uint8Array.from({ length: count }, (_, i) => (i % 3 === rest ? 1 : 0)));
  const asked = [undefined, ...masks.map((mask) => ({ mask })), { box }, { box, mask: masks[0]! }, { distance: 2.1 }];
  for (let step = 0; step < 30; step++) {
    const within = asked[(step * 5 + (step >> 2)) % asked.length];
    const place = [0.3 + 0.001 * step, 0.8, 2.5];
    const draft = cloud.visibleFrom(place, { within, draft: true });
    const seen = cloud.visibleFrom(place, { within });
    expect(seen.indices).toEqual(hiddenPointRemoval(positions, place, { within }).indices);
    const drafted = draft.mask();
    expect(seen.indices.every((i) => drafted[i] === 1)).toBe(true);
  }
  cloud.dispose();
});

it("a kept part follows changes of the cloud", () => {
  const cloud = new PointCloud(positions.subarray(0, 9000));
  expect(cloud.visibleFrom(from, { within: { box } }).count).toBeGreaterThan(0);
  cloud.append(positions.subarray(9000));
  cloud.remove([0, 1, 2, 3]);
  const all = Uint8Array.from({ length: count }, (_, i) => (i > 3 ? 1 : 0));
  const whole = new PointCloud(positions);
  const expected = whole.visibleFrom(from, { within: { box, mask: all } });
  expect(cloud.visibleFrom(from, { within: { box } }).indices).toEqual(expected.indices);
  whole.dispose();
  cloud.dispose();
});

it("workers give the same answers", async () => {
  const cloud = new PointCloud(positions);
  for (const workers of [1, 2]) {
    const remote = await WorkerPointCloud.create(positions, { workers });
    for (const within of choices) {
      const changing = within.mask === undefined ? within : { ...within, mask: mask.slice() };
      const asked = remote.visibleFrom(from, { within: changing });
      // The mask was copied: a later change does not concern the request.
      if ("mask" in changing) changing.mask.fill(0);
      expect((await asked).indices).toEqual(cloud.visibleFrom(from, { within }).indices);
    }
    const places = [from, [2, 0, 0]];
    const within = { distance: 2 };
    const any = await remote.visibleFromAny(places, { within });
    expect(any.indices).toEqual(cloud.visibleFromAny(places, { within }).indices);
    expect(await remote.illuminate(places, { within })).toEqual(cloud.illuminate(places, { within }));
    await remote.dispose();
  }
  cloud.dispose();
});

it("clouds in a plane follow a choice", () => {
  const flat = new PointCloud([0, 1, 0, 2, 3, 0], { dimension: 2 });
  const within = {
    distance: 3.5,
    box: [
      [-1, -1],
      [1, 5],
    ] as const,
  };
  expect([...flat.visibleFrom([0, 5], { within }).indices]).toEqual([1]);
  expect([...flat.visibleFrom([0, -2], { within }).indices]).toEqual([0]);
  flat.dispose();
});

it("choices that make no sense are refused", () => {
  const cloud = new PointCloud(positions);
  const bad: [unknown, RegExp][] = [
    [5, /within: the options must be a plain object/],
    [{ radius: 5 }, /within: unknown option "radius"/],
    [{ distance: "5" }, /distance must be a number/],
    [{ distance: -1 }, /within distance must be from 0 to infinity, got -1/],
    [{ distance: NaN }, /within distance/],
    [{ box: [[0, 0, 0]] }, /within box must be \[min, max\], each with 3 numbers/],
    [
      {
        box: [
          [0, 0],
          [1, 1],
        ],
      },
      /within box/,
    ],
    [
      {
        box: [
          [0, 0, "0"],
          [1, 1, 1],
        ],
      },
      /within box/,
    ],
    [
      {
        box: [
          [0, 0, 0],
          [1, 1, NaN],
        ],
      },
      /within box/,
    ],
    [
      {
        box: [
          [2, 0, 0],
          [1, 1, 1],
        ],
      },
      /no coordinate of min is above/,
    ],
    [{ mask: [1, 0] }, /within mask must be a Uint8Array/],
    [{ mask: new Uint8Array(3) }, /one element for each of 6000 indices, got 3/],
  ];
  for (const [within, message] of bad) {
    for (const ask of [
      () => cloud.visibleFrom(from, { within: within as object }),
      () => cloud.visibleFromAny([from], { within: within as object }),
    ]) {
      expect(ask).toThrow(expect.objectContaining({ code: "option" }));
      expect(ask).toThrow(message);
    }
  }
  expect(() => cloud.visibleFromDirection(from, { within: { distance: 3 } })).toThrow(
    /within distance cannot be combined with a direction/,
  );
  const four = new PointCloud(new Float64Array(16), { dimension: 4 });
  expect(() => four.visibleFrom([1, 2, 3, 4], { within: {} })).toThrow(/within needs a cloud of dimension 3, not 4/);
  four.dispose();
  cloud.dispose();
});
