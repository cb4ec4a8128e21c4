// Options of a view: how R is chosen, how points are flipped, what is done about noise.
import { describe, expect, it } from "vitest";

import { bumpySphere, bunny, randomNumbers, readyPackage } from "./support";

const { hiddenPointRemoval, PointCloud } = await readyPackage();

const sphere = bumpySphere(1, 2000);
const cloud = new PointCloud(sphere);
const farAway = [0, 0, 5];
const farthest = Math.max(
  ...Array.from({ length: 2000 }, (_, i) => Math.hypot(sphere[3 * i]!, sphere[3 * i + 1]!, sphere[3 * i + 2]! - 5)),
);

describe("the radius", () => {
  it.each([
    ["auto", 0, 0],
    ["search", 6, 6],
    ["opposite", 20, 60],
  ] as const)("is chosen by the rule %s, as autoRadius tells", (rule, fewest, most) => {
    const chosen = cloud.autoRadius(farAway, rule);
    expect(chosen.radius).toBeGreaterThanOrEqual(farthest * (1 - 1e-12));
    expect(chosen.exponent).toBeCloseTo(Math.log10(chosen.radius / farthest), 10);
    expect(chosen.evaluations).toBeGreaterThanOrEqual(fewest);
    expect(chosen.evaluations).toBeLessThanOrEqual(most);
    const visible = cloud.visibleFrom(farAway, { radius: rule });
    const { radius, exponent, evaluations } = visible;
    expect({ radius, exponent, evaluations }).toEqual(chosen);
    expect(visible.indices).toEqual(cloud.visibleFrom(farAway, { radius }).indices);
    expect(hiddenPointRemoval(sphere, farAway, { radius: rule })).toEqual(visible);
  });

  it("is the same by the three rules where there is nothing to search", () => {
    const none = new PointCloud([]);
    for (const rule of ["auto", "search", "opposite"] as const) {
      expect(none.autoRadius(farAway, rule)).toEqual({ radius: 0, exponent: 0, evaluations: 0 });
    }
  });

  it("of the paper's rule is the automatic one at the centroid", () => {
    const cube = new PointCloud([1, 1, 1, -1, 1, 1, 1, -1, 1, -1, -1, 1, 1, 1, -1, -1, 1, -1, 1, -1, -1, -1, -1, -1]);
    expect(cube.autoRadius([0, 0, 0], "opposite").radius).toBe(cube.autoRadius([0, 0, 0]).radius);
  });
});

describe("an inversion", () => {
  it("by a power tells itself and its unit, which fixes the rounding only", () => {
    const visible = cloud.visibleFrom(farAway, { inversion: { power: 2.5 } });
    expect(visible).toMatchObject({ inversion: { power: 2.5 }, exponent: 0, evaluations: 0 });
    expect(visible.radius).toBeCloseTo(farthest, 12);
    const scaled = cloud.visibleFrom(farAway, { radius: 64 * visible.radius, inversion: { power: 2.5 } });
    expect(scaled.radius).toBe(64 * visible.radius);
    expect(scaled.indices).toEqual(visible.indices);
  });

  it("by an exponential tells its scale, which is 0.07 spacings by itself", () => {
    const visible = cloud.visibleFrom(farAway, { inversion: { exponential: "auto" } });
    expect(visible).toMatchObject({ radius: 0, exponent: 0, evaluations: 0 });
    const { exponential } = visible.inversion as { exponential: number };
    expect(exponential).toBe(0.07 * cloud.spacing);
    expect(cloud.visibleFrom([0.1, -3, 1], { inversion: { exponential: "auto" } }).inversion).toEqual({ exponential });
    const given = cloud.visibleFrom(farAway, { inversion: { exponential } });
    expect(given).toEqual(visible);
  });

  it("shows the more, the less it bends", () => {
    const count = (inversion: object) => cloud.visibleFrom(farAway, { inversion } as never).count;
    expect(count({ power: 1.001 })).toBeGreaterThan(count({ power: 16 }));
    expect(count({ exponential: 0.0001 })).toBeGreaterThan(count({ exponential: 1 }));
  });

  it("hides the farther of two points on one ray, and says what it was asked", () => {
    const two = new PointCloud([0, 0, 1, 0, 0, 2]);
    for (const inversion of [
      "spherical",
      { power: 16 },
      { power: 1.0001 },
      { exponential: 1e-3 },
      { exponential: "auto" },
    ] as const) {
      expect([...two.visibleFrom(farAway, { inversion }).indices]).toEqual([1]);
    }
    expect(two.visibleFrom(farAway, { radius: "auto", inversion: "spherical" }).inversion).toBe("spherical");
  });
});

describe("noise", () => {
  const random = randomNumbers(5);
  const noisy = bunny().map((x) => x + 0.05 * (random() - 0.5));
  const bunnyCloud = new PointCloud(noisy);
  const viewpoint = [0, 5, 20];

  it("is voted on by each point and its nearest others", () => {
    const plain = bunnyCloud.visibleFrom(viewpoint).mask();
    const k = 7;
    const voted = Array.from({ length: plain.length }, (_, i) => {
      const distance = (j: number) =>
        Math.hypot(
          noisy[3 * i]! - noisy[3 * j]!,
          noisy[3 * i + 1]! - noisy[3 * j + 1]!,
          noisy[3 * i + 2]! - noisy[3 * j + 2]!,
        );
      const nearest = [...plain.keys()]
        .filter((j) => j !== i)
        .sort((a, b) => distance(a) - distance(b))
        .slice(0, k);
      const seen = [i, ...nearest].filter((j) => plain[j] === 1).length;
      return seen > 0.4 * (k + 1) ? 1 : 0;
    });
    expect([...bunnyCloud.visibleFrom(viewpoint, { vote: k }).mask()]).toEqual(voted);
  });

  it("is smoothed on to planes, but indices and positions stay", () => {
    const plain = bunnyCloud.visibleFrom(viewpoint);
    const smooth = bunnyCloud.visibleFrom(viewpoint, { denoise: 16 });
    expect(smooth.indices).not.toEqual(plain.indices);
    expect(smooth.mask()).toHaveLength(noisy.length / 3);
    expect(bunnyCloud.visibleFrom(viewpoint)).toEqual(plain);
    const both = bunnyCloud.visibleFrom(viewpoint, { denoise: 16, vote: 8, inversion: { exponential: "auto" } });
    expect(both.count).toBeGreaterThan(100);
  });

  it("changes nothing in a plane, where points are on theirs already", () => {
    const lattice = Float32Array.from(
      { length: 300 },
      (_, i) => [Math.floor(i / 30), Math.floor(i / 3) % 10, 0][i % 3]!,
    );
    const flat = new PointCloud(lattice);
    const options = { radius: 1000 };
    expect(flat.visibleFrom(farAway, { ...options, denoise: 8 }).indices).toEqual(
      flat.visibleFrom(farAway, options).indices,
    );
  });
});
