import { expect, it } from "vitest";

import type { VisibilityOptions } from "hidden-point-removal";
import { bumpySphere, expectRefusal, randomNumbers, readyPackage } from "./support";

const { PointCloud, hiddenPointRemoval } = await readyPackage();

const positions = bumpySphere(5, 1500);
const from = [0.3, 0.8, 2.5];
const random = randomNumbers(3);
/** Some in front of the surface, some behind it, some points of the cloud, and the viewpoint. */
const places = Float64Array.from({ length: 120 }, (_, i) =>
  i < 30 ? positions[3 * 7 + i]! : i < 33 ? from[i - 30]! : 2.4 * random() - 1.2,
);

/** The answer of a cloud with the point more, with the radius and the inversion of the view without it. */
function byDefinition(options: VisibilityOptions): number[] {
  const { radius, inversion } = hiddenPointRemoval(positions, from, options);
  const numbers = inversion === "spherical" ? { exponent: undefined, radius } : { inversion };
  const same = options.looks === undefined ? { ...options, ...numbers } : options;
  return Array.from({ length: places.length / 3 }, (_, i) => {
    const place = places.subarray(3 * i, 3 * i + 3);
    const isBeyond = inversion === "spherical" && Math.hypot(...place.map((x, axis) => x - from[axis]!)) > radius;
    return isBeyond
      ? 0
      : hiddenPointRemoval([...positions, ...place], from, same)
          .mask()
          .at(-1)!;
  });
}

const choices = [{}, { radius: 8 }, { looks: 2 as const }, { within: { distance: 2.2 } }];

it("the answer is that of a cloud with the one point more and the same radius", () => {
  const cloud = new PointCloud(positions);
  for (const options of choices) {
    const seen = cloud.sees(from, places, options);
    expect(seen).toBeInstanceOf(Uint8Array);
    expect(Array.from(seen)).toEqual(byDefinition(options));
  }
  expect(cloud.length).toBe(1500);
  expect(cloud.sees(from, [])).toEqual(new Uint8Array(0));
  cloud.dispose();
});

it("questions that make no sense are refused", async () => {
  const cloud = new PointCloud(positions);
  const bad: [unknown, object, string, RegExp][] = [
    [[1, 2], {}, "positions-length", /3 numbers/],
    ["5", {}, "positions-type", /positions/],
    [[0, 0, NaN], {}, "non-finite", /first at index 0/],
    [[0, 0, 0], { looks: 3, scores: true }, "option", /scores cannot be combined with sees/],
    [[0, 0, 0], { looks: 2, scores: true }, "option", /scores cannot be combined with sees/],
  ];
  for (const [places, options, code, message] of bad) {
    await expectRefusal(code, message, () => cloud.sees(from, places as number[], options));
  }
  const four = new PointCloud(new Float64Array(16), { dimension: 4 });
  expect(() => four.sees([1, 2, 3, 4], [0, 0, 0, 0])).toThrow(/sees needs a cloud of dimension 3, not 4/);
  four.dispose();
  cloud.dispose();
});
