// Generated clouds. They are the same on every machine, except for the last bits of sines.

/** Seeded numbers in 0 … 1 (mulberry32). */
export function seeded(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

export type Direction = [number, number, number];

/** The direction at height `z` (−1 … 1), turned by `turn` (0 … 1) around the z axis. */
export function direction(z: number, turn: number): Direction {
  const away = Math.sqrt(Math.max(0, 1 - z * z));
  return [away * Math.cos(2 * Math.PI * turn), away * Math.sin(2 * Math.PI * turn), z];
}

const WAVES = 24;
const SHAPE_SEED = 2007;

/**
 * The distance from the center to a closed surface with bumps and dents: 1, and up
 * to a third more or less. All clouds on it have the same shape.
 */
export function bumpyRadius(): (u: Direction) => number {
  const random = seeded(SHAPE_SEED);
  const waves = Array.from({ length: WAVES }, () => {
    const along = direction(2 * random() - 1, random());
    const frequency = 4 + 14 * random();
    return { along, frequency, phase: 2 * Math.PI * random(), height: 0.4 / frequency };
  });
  return ([x, y, z]) => {
    const height = ({ along, frequency, phase, height }: (typeof waves)[number]): number =>
      height * Math.sin(frequency * (along[0] * x + along[1] * y + along[2] * z) + phase);
    return waves.reduce((radius, wave) => radius + height(wave), 1);
  };
}

/** Points on the bumpy surface, evenly distributed over directions. */
export function bumpySurface(count: number, seed: number): Float32Array<ArrayBuffer> {
  const random = seeded(seed);
  return surface(count, bumpyRadius(), () => direction(2 * random() - 1, random()));
}

/** The same surface. Towards its upper pole it is more than a thousand times denser. */
export function unevenSurface(count: number, seed: number): Float32Array {
  const random = seeded(seed);
  return surface(count, bumpyRadius(), () => direction(1 - 2 * random() ** 4, random()));
}

export function sphere(count: number, seed: number): Float32Array {
  const random = seeded(seed);
  return surface(
    count,
    () => 1,
    () => direction(2 * random() - 1, random()),
  );
}

function surface(count: number, radius: (u: Direction) => number, next: () => Direction): Float32Array<ArrayBuffer> {
  const positions = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) {
    const u = next();
    const r = radius(u);
    for (let axis = 0; axis < 3; axis++) positions[3 * i + axis] = r * u[axis]!;
  }
  return positions;
}

/**
 * Hills over one square kilometer in UTM coordinates (easting 400,000, northing
 * 5,000,000), to the millimeter: far too fine for single precision.
 */
export function terrainUtm(count: number, seed: number): Float64Array {
  const random = seeded(seed);
  const waves = Array.from({ length: WAVES }, () => {
    const turn = 2 * Math.PI * random();
    const length = 40 + 400 * random();
    const k = (2 * Math.PI) / length;
    return { kx: k * Math.cos(turn), ky: k * Math.sin(turn), phase: 2 * Math.PI * random(), height: 0.04 * length };
  });
  const positions = new Float64Array(3 * count);
  const millimeters = (x: number): number => Math.round(x * 1000) / 1000;
  for (let i = 0; i < count; i++) {
    const [x, y] = [1000 * random(), 1000 * random()];
    const z = waves.reduce((sum, { kx, ky, phase, height }) => sum + height * Math.sin(kx * x + ky * y + phase), 300);
    positions.set([millimeters(4e5 + x), millimeters(5e6 + y), millimeters(z)], 3 * i);
  }
  return positions;
}
