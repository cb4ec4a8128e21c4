// Clouds in the plane (exact), and in four and more dimensions (within a tolerance).
import { describe, expect, it } from "vitest";

import { expectRefusal, randomNumbers, readyPackage, type Refusal } from "./support";

const { hiddenPointRemoval, PointCloud } = await readyPackage();
const loose = (value: unknown) => value as never;

describe("a cloud in the plane", () => {
  it("is a cloud in space with z = 0, to the bit", () => {
    const random = randomNumbers(4);
    const flat = Float32Array.from({ length: 600 }, () => random());
    const lifted = Float32Array.from({ length: 900 }, (_, i) =>
      i % 3 === 2 ? 0 : flat[2 * Math.floor(i / 3) + (i % 3)]!,
    );
    const [plane, space] = [new PointCloud(flat, { dimension: 2 }), new PointCloud(lifted)];
    const from = [0.5, 2];
    for (const options of [
      {},
      { radius: "opposite" },
      { inversion: { power: 2 } },
      { inversion: { exponential: "auto" } },
    ] as const) {
      expect(plane.visibleFrom(from, options)).toEqual(space.visibleFrom([...from, 0], options));
    }
    const [several, lifts] = [
      [from, [3, 0]],
      [
        [0.5, 2, 0],
        [3, 0, 0],
      ],
    ];
    expect(plane.visibleFromAny(several)).toEqual(space.visibleFromAny(lifts));
    expect(plane.visibleFromAtLeast(2, several)).toEqual(space.visibleFromAtLeast(2, lifts));
    expect(plane.autoRadius(from, "opposite")).toEqual(space.autoRadius([...from, 0], "opposite"));
    expect(hiddenPointRemoval(flat, from, { dimension: 2 })).toEqual(plane.visibleFrom(from));
  });
});

describe("refusals", () => {
  const plane = new PointCloud([0, 1, 2, 3], { dimension: 2 });
  const hyper = new PointCloud([0, 1, 2, 3], { dimension: 4 });
  const refusals: Refusal[] = [
    ["positions-length", /got 5\b.*multiple of 2/, () => new PointCloud([1, 2, 3, 4, 5], { dimension: 2 })],
    ["positions-length", /got 6\b.*multiple of 4/, () => hyper.append(new Float32Array(6))],
    ["non-finite", /index 1/, () => new PointCloud([1, 2, NaN, 4], { dimension: 2 })],
    ["non-finite", /index 1/, () => hyper.append([1, 2, 3, 4, 1, 2, 3, Infinity])],
    ["option", /index 1\b.*length 1/, () => hyper.remove([1])],
    ["option", /stride.*4/, () => new PointCloud([1, 2, 3, 4], { dimension: 4, stride: 3 })],
    ["viewpoint", /2 numbers.*3 of them/, () => plane.visibleFrom([0, 0, 5])],
    ["viewpoint", /NaN/, () => plane.visibleFrom([0, NaN])],
    ["viewpoint", /4 numbers.*3 of them/, () => hyper.visibleFrom([0, 0, 5])],
    ["viewpoint", /must be finite/, () => hyper.visibleFrom([0, 0, 5, NaN])],
    ["viewpoint", /viewpoints\[1\].*2 numbers/, () => plane.visibleFromAny([[0, 0], [0]])],
    [
      "option",
      /\bk\b.*got 3/,
      () =>
        hyper.visibleFromAtLeast(3, [
          [0, 0, 0, 1],
          [0, 0, 0, 2],
        ]),
    ],
    ["option", /reconstruct.*dimension 3, not 2/, () => plane.reconstruct([0, 5])],
    ["option", /illuminate.*dimension 3, not 4/, () => hyper.illuminate([])],
    ["option", /visibleFromDirection.*dimension 3, not 2/, () => plane.visibleFromDirection([0, 1])],
    ["radius", /farthest/, () => hyper.visibleFrom([0, 0, 0, 50], { radius: 1 })],
    ["option", /dimension.*1\b/, () => hiddenPointRemoval([1], [5], { dimension: 1 })],
    ["option", /dimension.*null/, () => new PointCloud([], loose({ dimension: null }))],
  ];
  it.each(refusals)("%s, naming %s: case %#", expectRefusal);
});
