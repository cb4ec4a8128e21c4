// Clouds in the plane (exact), and in four and more dimensions (within a tolerance).
import { describe, expect, it } from "vitest";

import { problemOf, randomNumbers, readyPackage } from "./support";

const { hiddenPointRemoval, PointCloud, HprError } = await readyPackage();
const loose = (value: unknown) => value as never;

/** The sign of a×b. In these tests a×b is far from 0, or exactly 0. */
const cross = ([a, b]: number[], [c, d]: number[]) => a! * d! - b! * c!;

/**
 * The definition in the plane, by brute force: q is visible unless a point beyond it on its
 * ray is in the hull of the flipped points and the viewpoint.
 */
function visibleInPlane(points: number[][], viewpoint: number[], radius: number): number[] {
  const flipped = points.map(([x, y]) => {
    const v = [x! - viewpoint[0]!, y! - viewpoint[1]!];
    const distance = Math.sqrt(v[0]! * v[0]! + v[1]! * v[1]!);
    return v.map((x) => x * ((2 * radius - distance) / distance));
  });
  return points.flatMap((_, i) => {
    const q = flipped[i]!;
    // How far along q its ray crosses an edge between two points, or to the viewpoint.
    const hides = flipped.some((a, j) =>
      flipped.some((b, k) => {
        if (j === i || k === i || k < j) return false;
        const [sa, sb] = [cross(q, a), cross(q, b)];
        if (j === k) return sa === 0 && a[0]! * q[0]! + a[1]! * q[1]! > q[0]! ** 2 + q[1]! ** 2;
        if (sa * sb >= 0) return false;
        const share = sa / (sa - sb);
        const hit = [0, 1].map((axis) => a[axis]! + share * (b[axis]! - a[axis]!));
        return hit[0]! * q[0]! + hit[1]! * q[1]! > (q[0]! ** 2 + q[1]! ** 2) * (1 + 1e-12);
      }),
    );
    return hides ? [] : [i];
  });
}

describe("a cloud in the plane", () => {
  it("is answered by the definition in two dimensions", () => {
    const random = randomNumbers(3);
    for (const viewpoint of [
      [0, 3],
      [0.1, -0.2],
      [-4, 1],
    ]) {
      const points = Array.from({ length: 70 }, () => [2 * random() - 1, 2 * random() - 1]);
      for (const positions of [points.flat(), Float64Array.from(points.flat())]) {
        const cloud = new PointCloud(positions, { dimension: 2 });
        expect(cloud).toHaveLength(70);
        for (const options of [{}, { exponent: 0.5 }, { exponent: 2 }, { radius: 30 }]) {
          const { indices, radius } = cloud.visibleFrom(viewpoint, options);
          expect([...indices]).toEqual(visibleInPlane(points, viewpoint, radius));
        }
      }
    }
  });

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
      { radius: "search" },
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
    expect(plane.autoRadius(from, "search")).toEqual(space.autoRadius([...from, 0], "search"));
    expect(hiddenPointRemoval(flat, from, { dimension: 2 })).toEqual(plane.visibleFrom(from));
  });
});

describe("a cloud of more dimensions", () => {
  it("is answered by the definition: on a sphere the near side", () => {
    const random = randomNumbers(6);
    for (const dimension of [4, 5]) {
      const rows = Array.from({ length: 300 }, () => {
        const row = Array.from({ length: dimension }, () => random() + random() + random() - 1.5);
        const length = Math.hypot(...row);
        return row.map((x) => x / length);
      });
      const viewpoint = Array.from({ length: dimension }, (_, axis) => (axis === dimension - 1 ? 50 : 0));
      for (const positions of [rows.flat(), Float32Array.from(rows.flat())]) {
        const cloud = new PointCloud(positions, { dimension });
        expect(cloud).toHaveLength(300);
        const { indices, radius } = cloud.visibleFrom(viewpoint);
        expect(radius).toBeGreaterThan(50);
        // The side that faces the viewer is convex, so all of it is visible. The far pole is not.
        const near = rows.flatMap((row, i) => (row.at(-1)! > 0.05 ? [i] : []));
        expect(near.every((i) => indices.includes(i))).toBe(true);
        expect(indices.length).toBeLessThan(300);
      }
    }
  });
});

describe("refusals", () => {
  const plane = new PointCloud([0, 1, 2, 3], { dimension: 2 });
  const hyper = new PointCloud([0, 1, 2, 3], { dimension: 4 });
  const refusals: [code: string, names: RegExp, call: () => unknown][] = [
    ["positions-length", /got 5\b.*multiple of 2/, () => new PointCloud([1, 2, 3, 4, 5], { dimension: 2 })],
    [
      "positions-length",
      /got 6\b.*multiple of 4/,
      () => {
        hyper.append(new Float32Array(6));
      },
    ],
    ["non-finite", /index 1/, () => new PointCloud([1, 2, NaN, 4], { dimension: 2 })],
    [
      "non-finite",
      /index 1/,
      () => {
        hyper.append([1, 2, 3, 4, 1, 2, 3, Infinity]);
      },
    ],
    [
      "option",
      /index 1\b.*length 1/,
      () => {
        hyper.remove([1]);
      },
    ],
    ["option", /stride.*4/, () => new PointCloud([1, 2, 3, 4], { dimension: 4, stride: 3 })],
    ["viewpoint", /2 numbers.*3 of them/, () => plane.visibleFrom([0, 0, 5])],
    ["viewpoint", /NaN/, () => plane.visibleFrom([0, NaN])],
    ["viewpoint", /4 numbers.*3 of them/, () => hyper.visibleFrom([0, 0, 5])],
    ["viewpoint", /4 finite/, () => hyper.visibleFrom([0, 0, 5, NaN])],
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
    ["option", /denoise.*dimension 3, not 2/, () => plane.visibleFrom([0, 5], { denoise: 1 })],
    ["option", /vote.*dimension 3, not 4/, () => hyper.visibleFrom([0, 0, 0, 5], { vote: 1 })],
    ["option", /reconstruct.*dimension 3, not 2/, () => plane.reconstruct([0, 5])],
    ["option", /illuminate.*dimension 3, not 4/, () => hyper.illuminate([])],
    ["option", /visibleFromDirection.*dimension 3, not 2/, () => plane.visibleFromDirection([0, 1])],
    ["radius", /farthest/, () => hyper.visibleFrom([0, 0, 0, 50], { radius: 1 })],
    ["option", /dimension.*1\b/, () => hiddenPointRemoval([1], [5], { dimension: 1 })],
    ["option", /dimension.*null/, () => new PointCloud([], loose({ dimension: null }))],
  ];
  it.each(refusals)("%s, naming %s: case %#", async (code, names, call) => {
    const problem = await problemOf(call);
    expect(problem).toBeInstanceOf(HprError);
    expect(problem.code).toBe(code);
    expect(problem.message).toMatch(names);
  });
});
