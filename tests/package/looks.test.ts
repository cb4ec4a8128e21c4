// The options looks and scores: in the page's thread and in a worker, and against the
// readable reference, tests/fidelity/three_looks.py.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { describe, expect, it } from "vitest";

import type { VisibilityOptions } from "hidden-point-removal";
import { bumpySphere, bunny, randomNumbers, readyPackage } from "./support";

const { hiddenPointRemoval, PointCloud, WorkerPointCloud } = await readyPackage();

const sphere = bumpySphere(1, 3000);
const farAway = [0, 0, 5];
const cloud = new PointCloud(sphere);

/** An answer of the reference, which is in Python. */
interface Reference {
  viewpoint: number[];
  /** One bit for each point. The first point is in the highest bit. */
  visible: string;
  /** One byte for each point: the score times 255. */
  scores: string;
}
/** The bunny of 1,839 points, and a vase whose points are near each other in rings, and far from ring to ring. */
const references = [
  ["bunny", bunny()],
  ["rings", rings(16, 300)],
].flatMap(([name, positions]) => {
  const file = fileURLToPath(new URL(`../fidelity/three-looks-of-${name as string}.json`, import.meta.url));
  const answers = JSON.parse(readFileSync(file, "utf8")) as Reference[];
  return answers.map((answer) => ({ name, positions: positions as Float32Array, ...answer }));
});

function rings(rows: number, corners: number): Float32Array {
  return Float32Array.from({ length: 3 * rows * corners }, (_, i) => {
    const [row, along] = [Math.floor(i / 3 / corners), Math.floor(i / 3) % corners];
    const up = (row + 0.5) / rows;
    const around = (2 * Math.PI * (along + 0.618 * row)) / corners;
    const away = 0.6 + 0.3 * Math.sin(9 * up);
    return [away * Math.cos(around), away * Math.sin(around), 2 * up][i % 3]!;
  });
}

describe("three looks", () => {
  it.each(references)("of $name agree with the readable reference", ({ positions, viewpoint, visible, scores }) => {
    const answer = new PointCloud(positions).visibleFrom(viewpoint, { looks: 3, scores: true });
    const bits = Buffer.from(visible, "base64");
    const mask = answer.mask();
    const differing = mask.filter((is, i) => is !== ((bits[i >> 3]! >> (7 - (i & 7))) & 1));
    expect(differing.length).toBeLessThan(0.005 * mask.length);
    const expected = Buffer.from(scores, "base64");
    const apart = answer.scores.filter((score, i) => Math.abs(score - expected[i]! / 255) > 0.02);
    expect(apart.length).toBeLessThan(0.01 * mask.length);
  });

  it("tell the scale of each look, and no radius", () => {
    const answer = cloud.visibleFrom(farAway, { looks: 3 });
    expect(answer).toMatchObject({ radius: 0, exponent: 0, evaluations: 0 });
    const { spacing } = cloud;
    expect(answer.inversion).toEqual({ looks: [0.28 * spacing, 0.07 * spacing, 0.02 * spacing] });
    expect(cloud.visibleFrom(farAway, { looks: 2 }).inversion).toEqual({ looks: [0.28 * spacing, 0.02 * spacing] });
    expect(hiddenPointRemoval(sphere, farAway, { looks: 3 })).toEqual(answer);
  });

  it("that a signal may give up are the same, and do not keep the next question waiting", async () => {
    const large = bumpySphere(2, 60_000);
    using worker = await WorkerPointCloud.create(large, { workers: 1 });
    const options: VisibilityOptions = { looks: 3, scores: true };
    const whole = await worker.visibleFrom(farAway, options);
    expect(await worker.visibleFrom(farAway, { ...options, signal: new AbortController().signal })).toEqual(whole);
    const moving = new AbortController();
    const givenUp = worker.visibleFrom(farAway, { ...options, signal: moving.signal });
    const refused = expect(givenUp).rejects.toMatchObject({ name: "AbortError" });
    // The request is with the worker now. Its reply is read later.
    moving.abort();
    await refused;
    expect(await worker.visibleFrom(farAway)).toEqual(new PointCloud(large).visibleFrom(farAway));
  });

  it("have scores only where they are asked for, one for each index", () => {
    expect("scores" in cloud.visibleFrom(farAway, { looks: 3, scores: false })).toBe(false);
    const some = new PointCloud([...sphere.subarray(0, 3000), NaN, 0, 0], { nonFinite: "skip" });
    some.remove([7, 8]);
    const { scores, indices } = some.visibleFrom(farAway, { looks: 3, scores: true });
    expect(scores).toBeInstanceOf(Float32Array);
    expect(scores).toHaveLength(1001);
    expect([scores[7], scores[8], scores[1000]]).toEqual([0, 0, 0]);
    expect(Math.min(...scores)).toBe(0);
    expect(Math.max(...scores)).toBeLessThanOrEqual(1);
    const mean = [...indices].reduce((sum, i) => sum + scores[i]!, 0) / indices.length;
    expect(mean).toBeGreaterThan(0.8);
    const none = some.visibleFrom(farAway, { looks: 3, scores: true, within: { distance: 0 } });
    expect(none.scores).toEqual(new Float32Array(1001));
  });
});

describe("a surface with noise", () => {
  const random = randomNumbers(4);
  // The sum of twelve uniform numbers is nearly normal.
  const normal = () => Array.from({ length: 12 }, random).reduce((sum, x) => sum + x, -6);
  const rough = bumpySphere(1, 6000).map((x) => x + 0.015 * normal());

  it("is seen as if it had none, in a worker too", async () => {
    const noisy = new PointCloud(rough);
    expect(new PointCloud(sphere).noise).toBe(0);
    expect(noisy.noise).toBeGreaterThan(0.005);
    const at = (options: Pick<VisibilityOptions, "thickness" | "surface">) =>
      noisy.visibleFrom(farAway, { looks: 3, ...options }).indices;
    const auto = at({});
    expect(auto.length).toBeGreaterThan(1.2 * at({ thickness: 0 }).length);
    expect(at({ thickness: "auto" })).toEqual(auto);
    expect(at({ thickness: 0.2 }).length).toBeGreaterThan(at({ thickness: 0 }).length);
    expect([noisy.surface, new PointCloud(sphere).surface]).toEqual(["noisy", "clean"]);
    expect(at({ surface: "noisy" })).toEqual(auto);
    expect(at({ surface: "auto" })).toEqual(auto);
    expect(at({ surface: "clean" }).length).toBeLessThan(0.9 * auto.length);
    expect(at({ surface: "layered" })).not.toEqual(auto);

    const other = await WorkerPointCloud.create(rough);
    expect(await other.noise).toBe(noisy.noise);
    expect(await other.surface).toBe("noisy");
    expect((await other.visibleFrom(farAway, { looks: 3 })).indices).toEqual(auto);
    const clean = await other.visibleFrom(farAway, { looks: 3, surface: "clean" });
    expect(clean.indices).toEqual(at({ surface: "clean" }));
    noisy.remove(auto);
    expect(noisy.noise).not.toBe(await other.noise);
    await other.dispose();
  });
});
