// The viewpoints, by one rule for all clouds. They lie on a sphere around the center of the
// cloud's box. The first lies in the direction (0.36, 0.48, 0.8). From there an orbit follows
// a great circle, so that its steps are angles seen from the center. Each cloud has its own
// radius of the sphere.
import type { Cloud } from "./clouds.js";
import type { Point, Task } from "./measure.js";

export const EXPONENTS = [2, 3, 4];

const FROM: Point = [0.36, 0.48, 0.8];
/** The horizontal direction at a right angle to `FROM`. */
const TOWARDS: Point = [0.8 / Math.hypot(0.8, 0.36), 0, -0.36 / Math.hypot(0.8, 0.36)];

const LARGE = 1_000_000;

/** The queries of every engine about a cloud. A large cloud gets fewer, to limit the time. */
export function tasksFor(cloud: Cloud): Task[] {
  const large = cloud.positions.length / 3 >= LARGE;
  const at = orbit(cloud);
  return EXPONENTS.map((exponent) => {
    return {
      exponent,
      viewpoint: at(0),
      away: at(180),
      runs: large ? 3 : 9,
    };
  });
}

/** The viewpoint after this many degrees of the orbit. */
export function orbit(cloud: Cloud): (degrees: number) => Point {
  const { center, radius } = bounds(cloud);
  return (degrees) => {
    const turn = (degrees * Math.PI) / 180;
    const along = (axis: number): number => Math.cos(turn) * FROM[axis]! + Math.sin(turn) * TOWARDS[axis]!;
    return center.map((x, axis) => x + cloud.distance * radius * along(axis)) as Point;
  };
}

/** The box's center and the radius of its corner sphere. */
export function bounds({ positions }: Pick<Cloud, "positions">): { center: Point; radius: number } {
  const low: Point = [Infinity, Infinity, Infinity];
  const high: Point = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i++) {
    const axis = i % 3;
    low[axis] = Math.min(low[axis]!, positions[i]!);
    high[axis] = Math.max(high[axis]!, positions[i]!);
  }
  const center = low.map((x, axis) => (x + high[axis]!) / 2) as Point;
  return { center, radius: Math.hypot(...low.map((x, axis) => x - center[axis]!)) };
}
