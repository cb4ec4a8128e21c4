import type { Cloud, LoadedCloud, PreparedCloud, Spacing, Values } from "./cloud.ts";

/** Makes a cloud ready to draw. It is slow for many points, so call it in a worker, not in the page's thread. */
export function prepareCloud({
  positions,
  colors,
  attributes = [],
  fields = attributes,
  facts = {},
  origin,
  ...said
}: LoadedCloud): PreparedCloud {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i += 3) {
    for (let axis = 0; axis < 3; axis++) {
      const value = positions[i + axis]!;
      if (value < low[axis]!) low[axis] = value;
      if (value > high[axis]!) high[axis] = value;
    }
  }
  const center = low.map((value, axis) => value / 2 + high[axis]! / 2) as [number, number, number];

  // The subtraction happens in f64: a georeferenced cloud keeps its millimeters on the graphics card.
  const local = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i++) local[i] = positions[i]! - center[i % 3]!;

  const size = high.map((value, axis) => value - low[axis]!) as [number, number, number];
  const radius = Math.hypot(...size) / 2;
  const body = bodyOf(local, size);
  const [x, y, z] = body?.size ?? size;
  // The view needs a size, even if there is only one point, or all points are equal.
  const cloud = {
    colors,
    attributes,
    fields,
    facts,
    origin: origin ?? null,
    count: positions.length / 3,
    center,
    local,
    size,
    radius: radius > 0 ? radius : 1,
    body,
    spacing: spacingOf(local, Math.sqrt((2 * (x * y + y * z + z * x)) / (local.length / 3))),
  };
  return { cloud, positions, copy: positions.slice(), ...said };
}

/** The share of points at either end of an axis that may be strays, and how much larger the whole box is with them. */
const STRAYS = 0.005;
const LARGER = 4;

function bodyOf(local: Float32Array, whole: Cloud["size"]): Cloud["body"] {
  const ends = [0, 1, 2].map((axis) => spreadOf(local.length / 3, (i) => local[3 * i + axis]!, STRAYS));
  const size = ends.map(([low, high]) => high - low) as Cloud["size"];
  const middle = ends.map(([low, high]) => low / 2 + high / 2) as Cloud["center"];
  const length = Math.hypot(...size);
  return length > 0 && Math.hypot(...whole) > LARGER * length ? { middle, size } : null;
}

/** Some points of a cloud, with all that is known about them. `kept`: their indices. */
export function partOf(cloud: LoadedCloud, kept: Uint32Array): LoadedCloud {
  const { positions, colors, attributes = [], fields = attributes } = cloud;
  // Most fields are attributes, too. Then both have the same numbers afterwards, too.
  const done = new Map<Values, Values>();
  const ofKept = <T extends { values: Values }>(column: T): T => {
    const values =
      done.get(column.values) ?? (column.values.length === 1 ? column.values : picked(column.values, kept, 1));
    done.set(column.values, values);
    return { ...column, values };
  };
  return {
    ...cloud,
    origin: cloud.origin ? picked(cloud.origin, kept, 1) : kept,
    positions: picked(positions, kept, 3),
    colors: colors && picked(colors, kept, 3),
    attributes: attributes.map(ofKept),
    fields: fields.map(ofKept),
  };
}

function picked<T extends Values>(values: T, kept: Uint32Array, width: number): T {
  const result = new (values.constructor as new (length: number) => T)(width * kept.length);
  for (let i = 0; i < kept.length; i++) {
    for (let k = 0; k < width; k++) result[width * i + k] = values[width * kept[i]! + k]!;
  }
  return result;
}

/** The shader's text for a point's own spacing. */
export const LOCAL_SPACING = "exp2((spread * 255.0 - 128.0) / 32.0)";
/** The same as a factor. */
export const localSpacing = (byte: number) => 2 ** ((byte - 128) / 32);

/** The number of points that are counted at most. Of more points, an even share is counted. */
const COUNTED = 1_000_000;
/** A cell with at least this many points tells how far apart they are. */
const ENOUGH = 6;
const LEVELS = 8;
/** Stray points are no balloons: nothing is farther apart than this many times the typical distance. */
const MOST = 2.5;

/**
 * Counts the points in the cells of ever coarser grids. The finest cell with enough points tells the spacing of its
 * points, as if they lay on a surface that crosses it. `rough`: the spacing if the points were spread evenly.
 */
export function spacingOf(positions: Float32Array, rough: number): Spacing {
  const count = positions.length / 3;
  const local = new Uint8Array(count).fill(128);
  if (!(rough > 0) || !Number.isFinite(rough)) return { typical: 0, local };
  const step = Math.ceil(count / COUNTED);
  const sizes = new Float32Array(count);
  let left = Uint32Array.from({ length: count }, (_, i) => i);
  for (let level = 0; level < LEVELS && left.length > 0; level++) {
    const cell = (rough / 4) * 2 ** level;
    const grid = new Grid(positions, cell, step);
    left = left.filter((i) => {
      const inside = grid.countAt(i);
      if (inside < ENOUGH && level < LEVELS - 1) return true;
      sizes[i] = cell / Math.sqrt(Math.max(1, inside) * step);
      return false;
    });
  }
  const typical = sizes.slice().sort()[count >> 1]!;
  for (let i = 0; i < count; i++) {
    const times = Math.min(MOST, sizes[i]! / typical);
    local[i] = Math.max(1, Math.round(128 + 32 * Math.log2(times)));
  }
  return { typical, local };
}

/** The numbers of points in the cells of a grid: a hash table with the next free place for each cell. */
class Grid {
  readonly #positions: Float32Array;
  readonly #cell: number;
  readonly #mask: number;
  readonly #cells: Float64Array;
  readonly #counts: Uint32Array;

  constructor(positions: Float32Array, cell: number, step: number) {
    const counted = Math.ceil(positions.length / 3 / step);
    const size = 2 ** Math.ceil(Math.log2(2 * counted + 2));
    this.#positions = positions;
    this.#cell = cell;
    this.#mask = size - 1;
    this.#cells = new Float64Array(size).fill(-1);
    this.#counts = new Uint32Array(size);
    for (let i = 0; i < positions.length / 3; i += step) this.#counts[this.#placeOf(i)]!++;
  }

  countAt(i: number): number {
    return this.#counts[this.#placeOf(i)]!;
  }

  #placeOf(i: number): number {
    const along = (axis: number) => (Math.floor(this.#positions[3 * i + axis]! / this.#cell) + 65_536) & 131_071;
    const [x, y, z] = [along(0), along(1), along(2)];
    const key = x + 131_072 * (y + 131_072 * z);
    let place = (Math.imul(x, 73_856_093) ^ Math.imul(y, 19_349_663) ^ Math.imul(z, 83_492_791)) & this.#mask;
    while (this.#cells[place] !== key && this.#cells[place] !== -1) place = (place + 1) & this.#mask;
    this.#cells[place] = key;
    return place;
  }
}

/** The share of values at either end that may be strays, and the number of values that are looked at. */
const RAMP_STRAYS = 0.01;
const SAMPLE = 5000;

/** Finds two values that have nearly all other values between them. Only finite values count. */
export function spreadOf(
  count: number,
  value: (i: number) => number,
  strays = RAMP_STRAYS,
): [low: number, high: number] {
  const step = Math.ceil(count / SAMPLE);
  const sample = new Float64Array(Math.ceil(count / step));
  let finite = 0;
  for (let i = 0; i < count; i += step) {
    const one = value(i);
    if (Number.isFinite(one)) sample[finite++] = one;
  }
  const sorted = sample.subarray(0, finite).sort();
  const at = (share: number) => sorted[Math.round(share * (finite - 1))] ?? 0;
  return [at(strays), at(1 - strays)];
}
