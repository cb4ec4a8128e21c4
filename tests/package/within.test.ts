import { expect, it } from "vitest";

import { bumpySphere, expectRefusal, pointsAt, readyPackage } from "./support";

const { PointCloud } = await readyPackage();

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
    for (const options of [{}, { exponent: 3 }, { looks: 3 as const, scores: true }]) {
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

it("choices that make no sense are refused", async () => {
  const between = (...corners: unknown[][]) => ({ box: corners });
  const cloud = new PointCloud(positions);
  const bad: [unknown, RegExp][] = [
    [5, /within: the options must be a plain object/],
    [{ radius: 5 }, /within: unknown option "radius"/],
    [{ distance: "5" }, /distance must be a number/],
    [{ distance: -1 }, /within distance must be from 0 to infinity, got -1/],
    [{ distance: NaN }, /within distance/],
    [{ box: [[0, 0, 0]] }, /within box must be \[min, max\], each with 3 numbers/],
    [between([0, 0], [1, 1]), /within box/],
    [between([0, 0, "0"], [1, 1, 1]), /within box/],
    [between([0, 0, 0], [1, 1, NaN]), /within box/],
    [between([2, 0, 0], [1, 1, 1]), /no coordinate of min is above/],
    [{ mask: [1, 0] }, /within mask must be a Uint8Array/],
    [{ mask: new Uint8Array(3) }, /one element for each of 6000 indices, got 3/],
  ];
  for (const [within, message] of bad) {
    for (const ask of [
      () => cloud.visibleFrom(from, { within: within as object }),
      () => cloud.visibleFromAny([from], { within: within as object }),
    ]) {
      await expectRefusal("option", message, ask);
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
