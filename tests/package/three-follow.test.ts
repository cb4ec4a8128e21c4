// Both filters for three.js: answers in motion, the answer at rest, several cameras, nodes that wait.
import { init, PointCloud } from "hidden-point-removal";
import { HiddenPointNodesFilter } from "hidden-point-removal/nodes";
import { HiddenPointFilter } from "hidden-point-removal/three";
import * as THREE from "three";
import { beforeAll, describe, expect, it } from "vitest";

import { BOTH, cameraAt, filters, pointsOf } from "./both-filters";
import { bumpySphere } from "./support";
import { drawn } from "./three-support";

const many = bumpySphere(4, 40_000);
const few = bumpySphere(5, 3000);
let local: PointCloud;

beforeAll(async () => {
  await init();
  local = new PointCloud(many);
});

const frame = () => new Promise((resolve) => setTimeout(resolve, 4));
const seenFrom = (camera: THREE.Camera, options = {}) => [
  ...local.visibleFrom(camera.position.toArray(), options).indices,
];

describe.each(BOTH)("%s", (_, make) => {
  function filterFor(points: THREE.Points, options: object = {}) {
    const filter = make(points, { settle: false, ...options });
    filters.push(filter);
    const changes: { answer: string; count: number; camera: THREE.Camera }[] = [];
    filter.addEventListener("change", (change: { answer: string; count: number; camera: THREE.Camera }) => {
      changes.push({ answer: change.answer, count: change.count, camera: change.camera });
    });
    const until = async (kind: string, camera: THREE.Camera) => {
      await expect
        .poll(
          () => {
            filter.update(camera);
            return filter.settled && filter.answer;
          },
          { interval: 2 },
        )
        .toBe(kind);
    };
    return { filter, changes, until };
  }

  const visibleOf = (filter: HiddenPointFilter | HiddenPointNodesFilter, points: THREE.Points) => [
    ...(filter instanceof HiddenPointFilter ? filter.visible : filter.visible.get(points)!),
  ];

  it("draws the exact answer, and at rest the answer of `settle`", async () => {
    const { points, geometry } = pointsOf(many);
    const { filter, changes, until } = filterFor(points, { exponent: 3, settle: { looks: 3 } });
    const camera = cameraAt(0, 0, 5);
    expect([filter.answer, filter.settled]).toEqual([null, false]);
    await until("looks", camera);
    expect(changes.map(({ answer }) => answer)).toEqual(["operator", "looks"]);
    const [exact, looks] = [
      local.visibleFrom([0, 0, 5], { exponent: 3 }).count,
      local.visibleFrom([0, 0, 5], { looks: 3 }).count,
    ];
    expect(changes.map(({ count }) => count)).toEqual([exact, looks]);
    expect(drawn(geometry)).toEqual(seenFrom(camera, { looks: 3 }));
    expect(visibleOf(filter, points)).toEqual(drawn(geometry));
    // Until a new view is answered, the last answer stays.
    camera.position.set(1, 0, 5);
    filter.update(camera);
    expect([filter.answer, filter.settled]).toEqual(["looks", false]);
    await until("looks", camera);
    expect(changes.slice(2).map(({ answer }) => answer)).toEqual(["operator", "looks"]);
  });

  it("draws all points, or the last answer, until the present view is answered", async () => {
    for (const stale of ["all", "keep"] as const) {
      const { points, geometry } = pointsOf(many);
      const { filter, changes, until } = filterFor(points, { stale });
      const camera = cameraAt(0, 0, 5);
      await until("operator", camera);
      const before = drawn(geometry);
      camera.position.set(5, 0, 0);
      filter.update(camera);
      expect(filter.settled).toBe(false);
      expect(drawn(geometry).length).toBe(stale === "all" ? 40_000 : before.length);
      await until("operator", camera);
      expect(drawn(geometry)).toEqual(seenFrom(camera));
      expect(changes.map(({ answer }) => answer)).toEqual(["operator", "operator"]);
    }
  });

  it("asks nothing for moves that are too short to be seen", async () => {
    const { points } = pointsOf(few);
    const { filter, changes, until } = filterFor(points);
    const camera = cameraAt(0, 0, 5);
    await until("operator", camera);
    const { spacing } = new PointCloud(few);
    // The end of a damped motion.
    for (let step = 0.0005 * spacing; step > 1e-12; step /= 2) {
      camera.position.x += step / 2;
      filter.update(camera);
      await frame();
    }
    expect(changes).toHaveLength(1);
    camera.position.x += 0.002 * spacing;
    filter.update(camera);
    expect(filter.settled).toBe(false);
  });

  it("draws for each of two cameras what this camera sees", async () => {
    const { points, geometry } = pointsOf(many);
    const { filter, changes } = filterFor(points);
    const cameras = [cameraAt(0, 0, 5), cameraAt(0, 5, 0)] as const;
    const seen = [new Set(seenFrom(cameras[0])), new Set(seenFrom(cameras[1]))];
    let others = 0;
    for (let step = 0; step < 60; step++) {
      cameras.forEach((camera, i) => {
        filter.update(camera);
        const picture = drawn(geometry);
        const isOwn = picture.length === 40_000 || picture.every((index) => seen[i]!.has(index));
        if (!isOwn) others++;
      });
      await frame();
    }
    await expect
      .poll(() =>
        cameras.every((camera) => {
          filter.update(camera);
          return filter.settled && filter.answer === "operator";
        }),
      )
      .toBe(true);
    expect(others).toBe(0);
    expect(changes.map(({ answer }) => answer)).toEqual(["operator", "operator"]);
    for (const camera of cameras) {
      filter.update(camera);
      expect(drawn(geometry)).toEqual(seenFrom(camera));
      expect(changes.filter((change) => change.camera === camera)).toHaveLength(1);
    }
    filter.dispose();
    expect([geometry.index, geometry.drawRange]).toEqual([null, { start: 0, count: Infinity }]);
  });

  it("remembers eight cameras", async () => {
    const { points, geometry } = pointsOf(few);
    const { filter, until } = filterFor(points);
    const cameras = Array.from({ length: 9 }, (_, i) => cameraAt(5 * Math.sin(i), 0, 5 * Math.cos(i)));
    for (const camera of cameras) await until("operator", camera);
    filter.update(cameras[1]!);
    expect(drawn(geometry).length).toBeLessThan(3000);
    filter.update(cameras[0]!);
    expect(drawn(geometry)).toHaveLength(3000);
  });

  it("refuses bad options", () => {
    const { points } = pointsOf(few);
    for (const options of [{ stale: 1 }, { settle: { looks: 5 } }, { stale: "draft" }]) {
      expect(() => make(points, options)).toThrow(expect.objectContaining({ name: "HprError", code: "option" }));
    }
  });
});

describe("nodes that wait for their first answer", () => {
  const isDrawn = (points: THREE.Points) => points.layers.mask !== 0;

  it("are not drawn with `pending: hide`, and have their layers back afterwards", async () => {
    const { points, group } = pointsOf(few);
    const filter = new HiddenPointNodesFilter(group, { pending: "hide" });
    filters.push(filter);
    const camera = cameraAt(0, 0, 5);
    points.layers.enable(3);
    const before = points.layers.mask;
    filter.update(camera);
    expect([isDrawn(points), filter.visible.get(points)!.length]).toEqual([false, 0]);
    await expect.poll(() => filter.settled).toBe(true);
    expect(points.layers.mask).toBe(before);

    const later = pointsOf(few.map((x) => x + 3)).points;
    group.add(later);
    filter.update(camera);
    expect([isDrawn(points), isDrawn(later)]).toEqual([true, false]);
    filter.enabled = false;
    expect(isDrawn(later)).toBe(true);
    filter.enabled = true;
    const last = pointsOf(few.map((x) => x - 3)).points;
    group.add(last);
    filter.update(camera);
    filter.dispose();
    expect([isDrawn(later), isDrawn(last)]).toEqual([true, true]);
  });

  it("are drawn by default, and if they are refused", async () => {
    const usual = pointsOf(few);
    const filter = new HiddenPointNodesFilter(usual.group);
    filters.push(filter);
    filter.update(cameraAt(0, 0, 5));
    expect(isDrawn(usual.points)).toBe(true);

    const broken = pointsOf(Float32Array.of(0, 0, NaN));
    const hiding = new HiddenPointNodesFilter(broken.group, { pending: "hide" });
    filters.push(hiding);
    hiding.addEventListener("error", () => undefined);
    hiding.update(cameraAt(0, 0, 5));
    await expect.poll(() => isDrawn(broken.points)).toBe(true);
    expect(() => new HiddenPointNodesFilter(broken.group, { pending: "no" as "hide" })).toThrow(/pending must be/);
  });
});
