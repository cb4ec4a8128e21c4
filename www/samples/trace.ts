/** Things that a ray can hit: boxes along the axes, spheres and upright cylinders. */

export type Vector = [number, number, number];

/** Its color, its class (numbers as in LAS files, the page's own numbers from 64 on), its reflectance. */
export interface Material {
  color: Vector;
  kind: number;
  gloss: number;
}

export interface Hit<M> {
  distance: number;
  normal: Vector;
  material: M;
}

/** Returns the first hit of a ray if it is nearer than `reach`. `along` has length 1. */
export type Solid<M> = (from: Vector, along: Vector, reach: number) => Hit<M> | null;

/** A box from its lower corner to its upper one. A ray from inside hits its inner sides. */
export function box<M>(low: Vector, high: Vector, material: M): Solid<M> {
  return (from, along, reach) => {
    let enter = -Infinity;
    let leave = Infinity;
    let enterAxis = 0;
    let leaveAxis = 0;
    for (let axis = 0; axis < 3; axis++) {
      const a = (low[axis]! - from[axis]!) / along[axis]!;
      const b = (high[axis]! - from[axis]!) / along[axis]!;
      const [near, far] = a < b ? [a, b] : [b, a];
      if (near > enter) [enter, enterAxis] = [near, axis];
      if (far < leave) [leave, leaveAxis] = [far, axis];
    }
    if (!(enter < leave) || leave <= 0) return null;
    const inside = enter <= 0;
    const distance = inside ? leave : enter;
    if (distance >= reach) return null;
    const axis = inside ? leaveAxis : enterAxis;
    const normal: Vector = [0, 0, 0];
    normal[axis] = along[axis]! > 0 ? -1 : 1;
    return { distance, normal, material };
  };
}

export function sphere<M>(center: Vector, radius: number, material: M): Solid<M> {
  return (from, along, reach) => {
    const [x, y, z] = [from[0] - center[0], from[1] - center[1], from[2] - center[2]];
    const half = x * along[0] + y * along[1] + z * along[2];
    const root = half * half - (x * x + y * y + z * z - radius * radius);
    const distance = -half - Math.sqrt(root);
    if (!(root > 0) || distance <= 0 || distance >= reach) return null;
    const normal = [0, 1, 2].map((axis) => (from[axis]! + distance * along[axis]! - center[axis]!) / radius) as Vector;
    return { distance, normal, material };
  };
}

/** Upright and open at both ends. */
export function cylinder<M>([cx, cy, cz]: Vector, radius: number, height: number, material: M): Solid<M> {
  return (from, along, reach) => {
    const [x, y] = [from[0] - cx, from[1] - cy];
    const a = along[0] ** 2 + along[1] ** 2;
    const half = x * along[0] + y * along[1];
    const root = half * half - a * (x * x + y * y - radius * radius);
    const distance = (-half - Math.sqrt(root)) / a;
    if (!(root > 0) || !(distance > 0) || distance >= reach) return null;
    const z = from[2] + distance * along[2];
    if (z < cz || z > cz + height) return null;
    return { distance, normal: [(x + distance * along[0]) / radius, (y + distance * along[1]) / radius, 0], material };
  };
}

/** Several solids as one. They are tested only if the ray meets the sphere `around`. */
export function group<M>(solids: readonly Solid<M>[], around?: Ball): Solid<M> {
  return (from, along, reach) => {
    if (around) {
      const [x, y, z] = [from[0] - around.center[0], from[1] - around.center[1], from[2] - around.center[2]];
      const half = x * along[0] + y * along[1] + z * along[2];
      if (half * half < x * x + y * y + z * z - around.radius ** 2) return null;
    }
    let first: Hit<M> | null = null;
    let nearest = reach;
    for (const solid of solids) {
      const hit = solid(from, along, nearest);
      if (!hit) continue;
      first = hit;
      nearest = hit.distance;
    }
    return first;
  };
}

/** A ball, and a solid that is inside it. */
export interface Ball {
  center: Vector;
  radius: number;
}

/** Many solids as one: they are cut in halves again and again, along x and y in turns, so that a ray is tested against few of them. */
export function nested<M>(things: readonly (Ball & { solid: Solid<M> })[], along: 0 | 1 = 0): Solid<M> {
  const center = [0, 1, 2].map((axis) =>
    things.reduce((sum, thing) => sum + thing.center[axis]! / things.length, 0),
  ) as Vector;
  const reachOf = (thing: Ball) =>
    Math.hypot(...thing.center.map((value, axis) => value - center[axis]!)) + thing.radius;
  const around = { center, radius: Math.max(...things.map(reachOf)) };
  const solids = things.map(({ solid }) => solid);
  if (solids.length < 3) return group(solids, around);
  const sorted = things.toSorted((a, b) => a.center[along] - b.center[along]);
  const half = things.length >> 1;
  const next = along === 0 ? 1 : 0;
  return group([nested(sorted.slice(0, half), next), nested(sorted.slice(half), next)], around);
}
