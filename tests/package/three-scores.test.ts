// Both filters for three.js: hidden points are dimmed by their scores, and a threshold of one's own.
import { init, PointCloud } from "hidden-point-removal";
import { HiddenPointNodesFilter } from "hidden-point-removal/nodes";
import { HiddenPointFilter, type HiddenPointFilterOptions } from "hidden-point-removal/three";
import * as THREE from "three";
import { beforeAll, describe, expect, it } from "vitest";

import { cameraAt, filters } from "./both-filters";
import { bumpySphere, problemOf } from "./support";

const COUNT = 3000;
const sphere = bumpySphere(5, COUNT);
const LOOKS = { looks: 3, scores: true } as const;
let local: PointCloud;

beforeAll(async () => {
  await init();
  local = new PointCloud(sphere);
});

/** The points of the sphere from one index to another. */
function pointsOf(from = 0, to = COUNT): THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial> {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(sphere.slice(3 * from, 3 * to), 3));
  return new THREE.Points(geometry, new THREE.PointsMaterial({ opacity: 0.8 }));
}

const answerFrom = (camera: THREE.Camera, options: object = LOOKS) =>
  local.visibleFrom(camera.position.toArray(), options);
const over = (scores: Float32Array, threshold: number) =>
  [...scores.keys()].filter((index) => scores[index]! >= threshold);

/** The child that draws the hidden points. */
function hiddenOf(points: THREE.Points) {
  const child = points.children[0] as THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial>;
  const { index, drawRange, attributes } = child.geometry;
  const listed = Array.from({ length: drawRange.count }, (_, i) => index!.getX(drawRange.start + i));
  return { child, listed, color: attributes["color"] as THREE.BufferAttribute };
}

/** The opacity that a hidden point must have, with an error of at most one in 255. */
function expectOpacities(points: THREE.Points, scores: Float32Array, full: number, first = 0): void {
  const { listed, color } = hiddenOf(points);
  expect(color.itemSize).toBe(4);
  expect(listed.length).toBeGreaterThan(100);
  const apart = listed.map((i) => {
    const expected = 0.15 + 0.85 * Math.min(1, scores[first + i]! / full);
    return Math.abs(color.getW(i) - expected);
  });
  expect(Math.max(...apart)).toBeLessThan(1 / 255);
}

describe("HiddenPointFilter", () => {
  function filterFor(points: THREE.Points, options: HiddenPointFilterOptions) {
    const filter = new HiddenPointFilter(points, { worker: false, ...options });
    filters.push(filter);
    return filter;
  }

  it.each([false, true])("dims by score what the answer hides, with worker: %s", async (worker) => {
    const [points, camera] = [pointsOf(), cameraAt(0, 0, 5)];
    const filter = filterFor(points, { ...LOOKS, worker, mode: "dim" });
    filter.update(camera);
    await filter.ready;
    const { indices, scores } = answerFrom(camera);
    expect([...filter.visible]).toEqual([...indices]);
    const { child, listed } = hiddenOf(points);
    expect(new Set([...listed, ...indices]).size).toBe(COUNT);
    expectOpacities(points, scores!, 0.5);
    expect(child.material).toMatchObject({ opacity: 0.8, vertexColors: true, transparent: true, depthWrite: false });
    expect(points.material.vertexColors).toBe(false);
  });

  it.each([0.2, 0.9])("draws the points whose score is at least %s", async (threshold) => {
    const camera = cameraAt(1, 2, 4);
    const scores = answerFrom(camera).scores!;
    const expected = over(scores, threshold);
    expect(expected).not.toEqual([...answerFrom(camera).indices]);
    for (const mode of ["hide", "dim"] as const) {
      for (const worker of [false, true]) {
        const points = pointsOf();
        const filter = filterFor(points, { ...LOOKS, mode, threshold, worker });
        const counts: number[] = [];
        filter.addEventListener("change", ({ count }) => counts.push(count));
        filter.update(camera);
        await filter.ready;
        expect([...filter.visible]).toEqual(expected);
        expect(counts).toEqual([expected.length]);
        if (mode === "dim") expectOpacities(points, scores, threshold);
      }
    }
  });

  it("keeps the colors of the points, follows their changes, and frees them", () => {
    const [points, camera] = [pointsOf(), cameraAt(0, 0, 5)];
    const own = new THREE.BufferAttribute(new Float32Array(3 * COUNT).fill(0.25), 3);
    points.geometry.setAttribute("color", own);
    points.material.vertexColors = true;
    const filter = filterFor(points, { ...LOOKS, mode: "dim" });
    filter.update(camera);
    const [i] = hiddenOf(points).listed as [number];
    const before = hiddenOf(points).color;
    expect([before.getX(i), before.getY(i), before.getZ(i)]).toEqual([0.25, 0.25, 0.25]);
    const { version } = before;
    filter.update(camera);
    expect(before.version).toBe(version);
    own.setXYZ(i, 1, 0.5, 0);
    own.needsUpdate = true;
    filter.update(camera);
    const after = hiddenOf(points).color;
    expect([after.getX(i), after.getY(i), after.getZ(i), after.version]).toEqual([1, 0.5, 0, version + 1]);
    expect(points.geometry.attributes["color"]).toBe(own);
    filter.dispose();
    expect(points.children).toEqual([]);
    expect(points.geometry.attributes["color"]).toBe(own);
  });

  it("dims evenly until the answer of `settle` has scores", async () => {
    const [points, camera] = [pointsOf(), cameraAt(0, 0, 5)];
    const filter = filterFor(points, { exponent: 3, settle: LOOKS, threshold: 0.6, mode: "dim" });
    filter.update(camera);
    expect(filter.answer).toBe("operator");
    expect([...filter.visible]).toEqual([...answerFrom(camera, { exponent: 3 }).indices]);
    const { listed, color } = hiddenOf(points);
    expect(new Set(listed.map((i) => Math.round(255 * color.getW(i))))).toEqual(new Set([38]));
    await expect.poll(() => (filter.update(camera), filter.answer), { interval: 5 }).toBe("looks");
    const scores = answerFrom(camera).scores!;
    expect([...filter.visible]).toEqual(over(scores, 0.6));
    expectOpacities(points, scores, 0.6);
  });

  it("refuses scores that nobody uses, and thresholds without scores or out of range", async () => {
    const refusal = async (options: object) => (await problemOf(() => filterFor(pointsOf(), options))).message;
    expect(await refusal(LOOKS)).toBe('scores need mode "dim" or a threshold');
    expect(await refusal({ settle: LOOKS })).toBe('scores need mode "dim" or a threshold');
    expect(await refusal({ looks: 3, threshold: 0.5 })).toBe("threshold needs looks and scores, or a settle with both");
    for (const threshold of [-0.1, 1.1, NaN, "0.5"]) {
      expect(await refusal({ ...LOOKS, threshold })).toMatch(/^threshold must be a number from 0 to 1, got/);
    }
  });
});

describe("HiddenPointNodesFilter", () => {
  it.each([undefined, 0.7])(
    "dims the points of each node by their own scores, with threshold %s",
    async (threshold) => {
      const [near, far, camera] = [pointsOf(0, 1200), pointsOf(1200), cameraAt(0, 0, 5)];
      const group = new THREE.Group().add(near, far);
      const filter = new HiddenPointNodesFilter(group, { ...LOOKS, mode: "dim", threshold, worker: false });
      filters.push(filter);
      await expect.poll(() => (filter.update(camera), filter.answer), { interval: 5 }).toBe("looks");
      const { indices, scores } = answerFrom(camera);
      const expected = threshold === undefined ? [...indices] : over(scores!, threshold);
      const drawn = filter.visible;
      expect([...drawn.get(near)!, ...drawn.get(far)!.map((i) => 1200 + i)]).toEqual(expected);
      expect(filter.visibleCount).toBe(expected.length);
      expectOpacities(near, scores!, threshold ?? 0.5);
      expectOpacities(far, scores!, threshold ?? 0.5, 1200);
    },
  );
});
