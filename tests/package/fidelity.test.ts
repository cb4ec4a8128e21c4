// The tools behind the fidelity tables and the figures, tested on surfaces whose truth is plain geometry.
import { init, PointCloud } from "hidden-point-removal";
import { beforeAll, describe, expect, test } from "vitest";
import { grid, joined, type Mesh } from "../../www/samples/generator.js";
import type { Point } from "../bench/measure.js";
import { type Curve, curves, meanCurve } from "../fidelity/curves.js";
import { AUTOMATIC, METHODS } from "../fidelity/methods.js";
import { RayTracer } from "../fidelity/rays.js";
import { errorsOf, score } from "../fidelity/score.js";
import { scatter } from "../fidelity/shapes.js";
import type { Labelled } from "../fidelity/truth.js";
import { withFigures } from "../figures/readme.js";

beforeAll(() => init());

const ball = (columns: number, rows: number): Mesh =>
  grid(columns, rows, (u, v) => {
    const [turn, down] = [2 * Math.PI * u, Math.PI * v];
    return [Math.sin(down) * Math.cos(turn), Math.sin(down) * Math.sin(turn), Math.cos(down)];
  });
/** A floor of 8 by 8 below the ball. */
const floor = grid(4, 4, (u, v) => [8 * u - 4, 8 * v - 4, -1.5]);

function point(positions: ArrayLike<number>, i: number): Point {
  return [positions[3 * i]!, positions[3 * i + 1]!, positions[3 * i + 2]!];
}

describe("rays", () => {
  const VIEWPOINT: Point = [1.5, -0.4, 2];

  test("see the side of a ball that faces the viewpoint", () => {
    const mesh = ball(120, 60);
    const seen = new RayTracer(mesh).visibleFrom(VIEWPOINT);
    const facing = Array.from(seen, (_, i) =>
      point(mesh.positions, i).reduce((sum, x, axis) => sum + x * VIEWPOINT[axis]!, -1),
    );
    // The silhouette of a ball of flat faces is a little off. At its poles many vertices share a place, and each has its
    // own faces.
    const isPole = (i: number) => Math.abs(mesh.positions[3 * i + 2]!) > 0.999999;
    const sure = facing.flatMap((height, i) => (Math.abs(height) > 0.1 && !isPole(i) ? [i] : []));
    expect(sure.length).toBeGreaterThan(0.9 * seen.length);
    expect(sure.filter((i) => seen[i] !== (facing[i]! > 0 ? 1 : 0))).toEqual([]);
  });

  test("see the part of a floor that the ball does not shade", () => {
    const mesh = joined([ball(120, 60), floor]);
    const onFloor = scatter(floor, 4000, 1);
    const seen = new RayTracer(mesh).visibleFrom(VIEWPOINT, {
      ...onFloor,
      faces: onFloor.faces!.map((face) => face + 2 * 120 * 60),
    });
    let [shaded, lit] = [0, 0];
    seen.forEach((label, i) => {
      const p = point(onFloor.positions, i);
      const way = VIEWPOINT.map((x, axis) => x - p[axis]!);
      const along = -way.reduce((sum, x, axis) => sum + x * p[axis]!, 0) / way.reduce((sum, x) => sum + x * x, 0);
      const clearance = Math.hypot(...p.map((x, axis) => x + along * way[axis]!));
      if (Math.abs(clearance - 1) < 0.01) return;
      expect(label, `a point that a ray leaves ${clearance} from the ball's middle`).toBe(clearance > 1 ? 1 : 0);
      if (label === 1) lit++;
      else shaded++;
    });
    expect(Math.min(shaded, lit)).toBeGreaterThan(200);
  });
});

test("points are scattered over the faces by area and density", () => {
  const { positions, faces } = scatter(floor, 10_000, 2, ([x]) => (x > 0 ? 3 : 1));
  const right = Array.from(faces!, (_, i) => point(positions, i)).filter(([x]) => x > 0).length;
  expect(right).toBe(7500);
  for (let i = 0; i < 10_000; i += 97) {
    const [x, y, z] = point(positions, i);
    expect(z).toBe(-1.5);
    // The floor has four rows of four squares. Each square has two faces.
    expect(Math.floor(faces![i]! / 2)).toBe(4 * Math.floor((y + 4) / 2) + Math.floor((x + 4) / 2));
  }
});

test("errors are counted by their kind", () => {
  const errors = errorsOf(Uint8Array.of(1, 1, 1, 0, 0), Uint8Array.of(1, 0, 0, 1, 0));
  expect(errors).toEqual({ falsePositives: 40, falseNegatives: 20, total: 60 });
});

describe("a ball seen from two places", () => {
  let labelled: Labelled;
  beforeAll(() => {
    const mesh = ball(120, 60);
    const points = scatter(mesh, 3000, 3);
    const tracer = new RayTracer(mesh);
    const views = [[0, 0, 3] as Point, [1, -1, 2] as Point].map((viewpoint) => ({
      viewpoint,
      seen: tracer.visibleFrom(viewpoint, points),
    }));
    labelled = { name: "ball", positions: points.positions, views };
  });

  test("errors go from negatives to positives as R grows", () => {
    const cloud = new PointCloud(labelled.positions);
    const both = curves(labelled, [0.5, 1.5, 2.5, 3.5, 4.5]);
    both.forEach(({ errors, rules }, i) => {
      for (const at of errors) expect(at.total).toBeCloseTo(at.falsePositives + at.falseNegatives, 10);
      const positives = errors.map(({ falsePositives }) => falsePositives);
      const negatives = errors.map(({ falseNegatives }) => falseNegatives);
      expect(positives).toEqual(positives.toSorted((a, b) => a - b));
      expect(negatives).toEqual(negatives.toSorted((a, b) => b - a));
      expect(rules[0]!.exponent).toBe(cloud.autoRadius(labelled.views[i]!.viewpoint).exponent);
    });
    cloud.dispose();
    const mean = meanCurve(both);
    expect(mean.views).toBe(2);
    const of = (pick: (curve: Curve) => number) => (pick(both[0]!) + pick(both[1]!)) / 2;
    expect(mean.errors[2]!.total).toBeCloseTo(
      of(({ errors }) => errors[2]!.total),
      12,
    );
    expect(mean.rules[1]!.exponent).toBeCloseTo(
      of(({ rules }) => rules[1]!.exponent),
      12,
    );
  });

  test("every way of asking is scored against the best R", () => {
    const scores = score(labelled, METHODS);
    expect(scores.length).toBe(2 * METHODS.length);
    const automatic = scores.filter(({ method }) => method === AUTOMATIC.name);
    // The best R leaves 13 of 3,000 points in one view, the automatic one 28.
    expect(automatic.every(({ total, ratio, hulls }) => total < 5 && ratio! < 2.5 && hulls === 1)).toBe(true);
    // The best of all exponents is at least as good as any of these three.
    for (const { method, ratio } of scores) {
      if (/^exponent [234]$/.test(method)) expect(ratio).toBeGreaterThanOrEqual(1);
    }
  });
});

test("a figure's new section replaces the old one, and the others stay", () => {
  const figure = (name: string, caption: string) => ({ name, title: name, caption, png: Buffer.of() });
  const first = withFigures("", [figure("radius", "dark"), figure("bunny", "white")]);
  const second = withFigures(first, [figure("radius", "darker")]);
  expect(second).toBe(first.replace("dark\n", "darker\n"));
  expect(second.indexOf("white")).toBeLessThan(second.indexOf("darker"));
});
