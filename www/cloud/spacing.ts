/** How far apart the points of a cloud are: typically, and near each point. */
export interface Spacing {
  typical: number;
  /** One byte a point: `typical` · 2 ^ ((byte − 128) / 32). */
  local: Uint8Array<ArrayBuffer>;
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
    local[i] = Math.max(0, Math.round(128 + 32 * Math.log2(times)));
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
const STRAYS = 0.01;
const SAMPLE = 5000;

/** Finds two values that have nearly all other values between them. Only finite values count. */
export function spreadOf(count: number, value: (i: number) => number, strays = STRAYS): [low: number, high: number] {
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
