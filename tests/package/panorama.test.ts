import { expect, it } from "vitest";

import { randomNumbers, readyPackage } from "./support";

const { PointCloud } = await readyPackage();

const SKY = 2 ** 32 - 1;
const size = { width: 128, height: 64 };

/** Points on a hemisphere of radius 5 above the origin. */
function dome(count: number): Float32Array {
  const random = randomNumbers(1);
  const points = Array.from({ length: count }, () => {
    const [z, turn] = [random(), 2 * Math.PI * random()];
    const across = 5 * Math.sqrt(1 - z * z);
    return [across * Math.cos(turn), across * Math.sin(turn), 5 * z];
  });
  return Float32Array.from(points.flat());
}

const positions = dome(10_000);
const cloud = new PointCloud(positions);

it("gives ranges, points and areas of a dome", () => {
  const { ranges, indices, skyViewFactor, solidAngle } = cloud.panorama([0, 0, 0], size);
  expect([ranges.length, indices.length]).toEqual([128 * 64, 128 * 64]);
  expect(Math.abs(solidAngle / (2 * Math.PI) - 1)).toBeLessThan(0.01);
  expect(skyViewFactor).toBeLessThan(0.001);
  const isRight = (range: number, pixel: number) => {
    const isSky = indices[pixel] === SKY;
    const isDome = pixel < 128 * 30 && Math.abs(range - 5) < 0.05;
    return (range === Infinity) === isSky && (isDome || (pixel >= 128 * 30 && (isSky || pixel < 128 * 32)));
  };
  expect([...ranges].filter((range, pixel) => !isRight(range, pixel))).toEqual([]);
  // Column 0 looks along +x, a quarter of the width later it is +y.
  const [x, y] = [0, 32].map((column) => indices[20 * 128 + column]!);
  expect(positions[3 * x!]! / 5).toBeGreaterThan(0.7);
  expect(positions[3 * y! + 1]! / 5).toBeGreaterThan(0.7);
});

it("refuses what has no panorama", () => {
  const refused = (options: object, at: unknown = [0, 0, 0], of = cloud) => {
    try {
      of.panorama(at as number[], options as never);
    } catch (error) {
      return (error as { code: string }).code;
    }
    return "no error";
  };
  const wrong = [
    {},
    { width: 8 },
    { height: 8 },
    { ...size, width: 0 },
    { ...size, width: 16_385 },
    { ...size, height: 1.5 },
    { ...size, height: "8" },
    { ...size, looks: 3, scores: true },
    { ...size, looks: 3, scores: true },
    { ...size, size: 1 },
  ];
  for (const options of wrong) expect([options, refused(options)]).toEqual([options, "option"]);
  for (const up of [[0, 0, 0], [1, 2], [NaN, 0, 1], "z"]) expect(refused({ ...size, up })).toBe("viewpoint");
  expect(refused(size, [NaN, 0, 0])).toBe("viewpoint");
  expect(refused(size, [0, 0])).toBe("viewpoint");
  expect(refused({ ...size, radius: 1 })).toBe("radius");
  const flat = new PointCloud([1, 2, 3, 4], { dimension: 2 });
  expect(refused(size, [0, 0], flat as never)).toBe("option");
  flat.dispose();
});
