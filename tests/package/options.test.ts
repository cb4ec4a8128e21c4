// Options of a view: how R is chosen, how points are flipped, what is done about noise.
import { describe, expect, it } from "vitest";

import { bumpySphere, readyPackage } from "./support";

const { PointCloud } = await readyPackage();

const sphere = bumpySphere(1, 2000);
const cloud = new PointCloud(sphere);
const farAway = [0, 0, 5];
const farthest = Math.max(
  ...Array.from({ length: 2000 }, (_, i) => Math.hypot(sphere[3 * i]!, sphere[3 * i + 1]!, sphere[3 * i + 2]! - 5)),
);

describe("the radius", () => {
  it("is the same by both rules where there is nothing to choose", () => {
    const none = new PointCloud([]);
    for (const rule of ["auto", "opposite"] as const) {
      expect(none.autoRadius(farAway, rule)).toEqual({ radius: 0, exponent: 0, evaluations: 0 });
    }
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
});
