import { allocating, HprError } from "../base/errors.js";
import { requireInstance } from "../instance/instance.js";
import { givenOptions, integer, number } from "../query/options.js";
import { readViewpoint, type Viewpoint } from "../query/positions.js";

/** How viewpoints are added around a viewpoint. */
export interface RingOptions {
  /** The number of added viewpoints: an integer from 1 to 10,000. Default 4. */
  count?: number | undefined;
  /** The ring's radius ÷ the distance to the target, at least 0. Default 0.05. */
  fraction?: number | undefined;
}

const MOST_VIEWPOINTS = 10_000;

/**
 * Returns viewpoints evenly spaced on a circle around a given viewpoint (paper, §5). The circle is
 * perpendicular to the line from the viewpoint to a target. The viewpoint itself is not among them.
 * Use them with `PointCloud.visibleFromAny` and `PointCloud.visibleFromAtLeast`.
 *
 * @param viewpoint x, y, z.
 * @param target x, y, z of the place that the viewer looks at, in the same units.
 * @throws HprError `not-initialised`, `viewpoint` (for the target, too), `option`.
 */
export function ringOfViewpoints(viewpoint: Viewpoint, target: Viewpoint, options?: RingOptions): number[][] {
  const instance = requireInstance();
  const from = Float64Array.from(readViewpoint(viewpoint, 3));
  const to = Float64Array.from(readViewpoint(target, 3, "target"));
  const given = givenOptions(options, ["count", "fraction"]);
  const count = integer(given, "count", 1, MOST_VIEWPOINTS) ?? 4;
  const fraction = number(given, "fraction") ?? 0.05;
  const ring = allocating(`${count} viewpoints`, () => new Float64Array(3 * count));
  instance.call((bindings) => {
    bindings.ringOfViewpoints(from, to, fraction, ring);
  });
  return Array.from({ length: count }, (_, i) => [...ring.subarray(3 * i, 3 * i + 3)]);
}

/**
 * The largest curvature k of a pit whose bottom is still found visible (paper, Lemma 4.3), in the
 * inverse of the unit of length:
 *
 * k < [4R(2R − r)·cot²β + 2Rr] / (4Rr − 4R² + (r − 2R)²/sin²β)^(3/2)
 *
 * @param R the radius of the flipping sphere.
 * @param r the point's distance from the viewpoint: 0 < r ≤ R.
 * @param beta the angle β between the ray and the hull's plane at the *flipped* point, from 0 to π.
 *   With π/2, the plane faces the viewer.
 * @throws HprError `not-initialised`, `option`.
 */
export function permissibleCurvature(R: number, r: number, beta: number): number {
  const instance = requireInstance();
  checkNumbers({ R, r, beta });
  return instance.call((bindings) => bindings.permissibleCurvature(R, r, beta));
}

/**
 * The radius R below which the back of a body stays hidden (paper, §4): thickness · distance² /
 * spacing². The back of the body is at `distance` from the viewpoint, and the samples of its front lie
 * twice the `spacing` apart. With a larger R, the back shows between the samples of the front.
 *
 * @throws HprError `not-initialised`; `option` for a number that is not positive and finite.
 */
export function radiusBound(thickness: number, distance: number, spacing: number): number {
  const instance = requireInstance();
  checkNumbers({ thickness, distance, spacing });
  return instance.call((bindings) => bindings.radiusBound(thickness, distance, spacing));
}

function checkNumbers(values: Record<string, unknown>): void {
  for (const [name, value] of Object.entries(values)) {
    if (value === undefined) {
      throw new HprError("option", `${name} must be a number, got undefined`);
    }
    number(values, name);
  }
}
