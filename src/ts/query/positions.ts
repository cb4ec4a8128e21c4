import { allocating, describe, HprError } from "../base/errors.js";
import { isNumberArray, type NumberArray, plainNumbers, typedArrayType } from "../base/typed-arrays.js";

/**
 * The coordinates of points: x, y, z of one point after another. A Float32Array is kept in single
 * precision. Any other typed array of numbers, or array of numbers, is read in double precision.
 * Arrays of BigInts and of 16-bit floats are refused. Views of a SharedArrayBuffer are accepted.
 * The positions are always copied.
 */
export type Positions = NumberArray | ArrayLike<number>;

/** A place: as many numbers as the cloud has dimensions, or an object with x, y and z, such as a vector of three.js. */
export type Viewpoint = ArrayLike<number> | { readonly x: number; readonly y: number; readonly z: number };

/** The core's limit. It is checked here, too, before anything is copied. */
export const MOST_POINTS = 2 ** 28;
/** The largest length of an array: a 32-bit memory cannot address more. */
export const MAX_LENGTH = 2 ** 32 - 1;

/**
 * Positions in a form that wasm can copy from. If the caller's array is an array of floats, this is
 * a plain view of its memory. Otherwise it is a new array.
 */
export function readPositions(positions: unknown, stride: number): Float32Array | Float64Array {
  if (isNumberArray(positions)) {
    const numbers = viewOf(positions);
    checkLimits(numbers.length, stride);
    checkMultiple(numbers.length, stride);
    return isFloatArray(numbers)
      ? numbers
      : allocating(`${numbers.length} coordinates`, () => new Float64Array(numbers));
  }
  const numbers = fromArrayLike(positions, stride);
  // The length is checked last: for [[1, 2, 3]], an error about the nesting says more.
  checkMultiple(numbers.length, stride);
  return numbers;
}

/**
 * The number of coordinates that a point has in the core. The core reads a cloud in a plane as a
 * cloud in space with z = 0. This does not change any rounding.
 */
export function coreDimension(dimension: number): number {
  return Math.max(dimension, 3);
}

/**
 * The coordinates in the core's own dimension, without the numbers that the stride skips. The core
 * reads nothing else. Above three dimensions, they are in double precision.
 */
export function packed(
  numbers: Float32Array | Float64Array,
  stride: number,
  dimension: number,
): Float32Array | Float64Array {
  const Type = numbers.BYTES_PER_ELEMENT === 4 && dimension <= 3 ? Float32Array : Float64Array;
  const width = coreDimension(dimension);
  if (stride === dimension && width === dimension && Type.BYTES_PER_ELEMENT === numbers.BYTES_PER_ELEMENT) {
    return numbers;
  }
  const count = numbers.length / stride;
  if (count * width > MAX_LENGTH) {
    throw new HprError("too-large", `${count * width} coordinates exceed the limit of ${MAX_LENGTH}`);
  }
  const own = allocating(`${count} points`, () => new Type(width * count));
  let to = 0;
  for (let from = 0; from < numbers.length; from += stride) {
    for (let axis = 0; axis < dimension; axis++) {
      own[to + axis] = numbers[from + axis] as number;
    }
    to += width;
  }
  return own;
}

/**
 * A viewpoint's coordinates, in the core's dimension. They are checked here: the core knows neither that a plane has
 * two, nor which of several viewpoints is refused.
 */
export function readViewpoint(given: unknown, dimension: number, name = "viewpoint"): number[] {
  const viewpoint = listed(given, dimension);
  const length = lengthOf(viewpoint);
  if (length !== dimension) {
    const got = length === undefined ? describe(viewpoint) : `${length} of them`;
    throw new HprError("viewpoint", `the ${name} must be ${dimension} numbers, got ${got}`);
  }
  // Each is read only once: a getter may return another value the next time.
  const coordinates = Array.from({ length }, (_, axis) => (viewpoint as ArrayLike<unknown>)[axis]);
  if (!coordinates.every((x) => typeof x === "number")) {
    throw new HprError(
      "viewpoint",
      `the ${name} must be ${dimension} numbers, got ${coordinates.map(describe).join(", ")}`,
    );
  }
  if (!coordinates.every(Number.isFinite)) {
    throw new HprError("viewpoint", `the ${name} must be finite, got ${coordinates.join(", ")}`);
  }
  return dimension === 2 ? [...coordinates, 0] : coordinates;
}

/** Any object with x, y and z, such as a vector of three.js, as a list. Its class may have a method `length`. */
export function listed(given: unknown, dimension: number): unknown {
  if (dimension > 3 || typeof given !== "object" || given === null || ArrayBuffer.isView(given)) {
    return given;
  }
  if (Array.isArray(given) || !("x" in given) || lengthOf(given) !== undefined) {
    return given;
  }
  const { x, y, z } = given as { x: unknown; y?: unknown; z?: unknown };
  return dimension === 2 ? [x, y] : [x, y, z];
}

/** The coordinates of several viewpoints, one after another. An error says which viewpoint it is about. */
export function readViewpoints(viewpoints: unknown, dimension: number, name: string): Float64Array<ArrayBuffer> {
  const lists = readEach(viewpoints, name, `${dimension} numbers each`, (viewpoint, which) =>
    readViewpoint(viewpoint, dimension, `viewpoint ${which}`),
  );
  return allocating(`${lists.length} viewpoints`, () => Float64Array.from(lists.flat()));
}

/** Reads each entry of a list of places. `contents` and `which` (the list's name and the entry's number) are for errors. */
export function readEach<T>(
  list: unknown,
  name: string,
  contents: string,
  read: (given: unknown, which: string) => T,
): T[] {
  if (!Array.isArray(list)) {
    throw new HprError("viewpoint", `${name} must be an array of ${contents}, got ${describe(list)}`);
  }
  return Array.from(list, (given: unknown, i) => read(given, `${name}[${i}]`));
}

/** A copy of the indices of points. The core checks that the cloud has these points. */
export function readIndices(indices: unknown): Uint32Array<ArrayBuffer> {
  const length = lengthOf(isNumberArray(indices) ? plainNumbers(indices) : indices);
  if (length === undefined) {
    throw new HprError(
      "option",
      `indices must be an array of integers, not transferred away, got ${describe(indices)}`,
    );
  }
  const integers = allocating(`${length} indices`, () => new Uint32Array(length));
  for (let i = 0; i < length; i++) {
    const index = (indices as ArrayLike<unknown>)[i];
    if (typeof index !== "number" || index >>> 0 !== index) {
      throw new HprError("option", `indices[${i}] must be the index of a point, got ${describe(index)}`);
    }
    integers[i] = index;
  }
  return integers;
}

/** Refuses a mask, ones and zeros for each of so many points: as indices, it would name the points 0 and 1 alone. */
export function refuseMask(indices: Uint32Array, count: number, whose = ""): void {
  if (count > 2 && indices.length === count && indices.every((index) => index <= 1)) {
    throw new HprError("option", `${whose}indices must be numbers of points, got a mask`);
  }
}

export function isFloatArray(value: unknown): value is Float32Array | Float64Array {
  const type = typedArrayType(value);
  return type === "Float32Array" || type === "Float64Array";
}

function viewOf(positions: NumberArray): NumberArray {
  const numbers = plainNumbers(positions);
  if (numbers === undefined) {
    throw positionsGone();
  }
  return numbers;
}

export function positionsGone(): HprError {
  return new HprError(
    "positions-type",
    "the memory of the positions is gone: their buffer has been transferred away or made smaller",
  );
}

function checkLimits(length: number, stride: number): void {
  if (length > MOST_POINTS * stride) {
    const count = Math.floor(length / stride);
    throw new HprError("too-large", `${count} points exceed the limit of ${MOST_POINTS}`);
  }
  if (length > MAX_LENGTH) {
    throw new HprError("too-large", `${length} coordinates exceed the limit of ${MAX_LENGTH}`);
  }
}

function checkMultiple(length: number, stride: number): void {
  if (length % stride !== 0) {
    throw new HprError(
      "positions-length",
      `expected ${stride} numbers for each point, got ${length}, which is not a multiple of ${stride}`,
    );
  }
}

function fromArrayLike(positions: unknown, stride: number): Float64Array {
  const length = ArrayBuffer.isView(positions) ? undefined : lengthOf(positions);
  if (length === undefined) {
    throw new HprError(
      "positions-type",
      `positions must be a typed array of numbers or an array of numbers, got ${describe(positions)}`,
    );
  }
  checkLimits(length, stride);
  const numbers = allocating(`${length} coordinates`, () => new Float64Array(length));
  for (let i = 0; i < length; i++) {
    const number = (positions as ArrayLike<unknown>)[i];
    if (typeof number !== "number") {
      throw new HprError("positions-type", `positions[${i}] must be a number, got ${describe(number)}`);
    }
    numbers[i] = number;
  }
  return numbers;
}

/** The length of an array or of an object like one. Read only once: a getter may return another value later. */
function lengthOf(value: unknown): number | undefined {
  if (typeof value !== "object" || value === null || !("length" in value)) {
    return undefined;
  }
  const { length } = value;
  return Number.isSafeInteger(length) && (length as number) >= 0 ? (length as number) : undefined;
}

/** The viewpoint of a view, or the direction that it looks along. */
export interface Place {
  readonly from: readonly number[];
  readonly isDirection: boolean;
  /** The directions of its picture. Undefined: all. */
  readonly cone?: Directions | undefined;
}

/** A cone: its axis, of length 1, and its full opening in degrees. */
export interface Directions {
  readonly direction: readonly number[];
  readonly angle: number;
}

/** A shorter move, as a share of the cloud's spacing, cannot be seen. */
const MOVE = 1e-3;
/** The same for a direction of length 1. */
const TURN = 1e-6;

/**
 * Whether an answer for `a` need not be asked again for `b`. NaN is equal to NaN, so that it is refused only once. `rounding`:
 * how far rounding alone may move a viewpoint.
 */
export function isNear(a: Place, b: Place, spacing: number, rounding = 0): boolean {
  if (a.isDirection !== b.isDirection || a.from.length !== b.from.length) {
    return false;
  }
  const blur = (a.isDirection ? TURN * Math.hypot(...a.from) : MOVE * spacing) + rounding;
  const farthest = Number.isFinite(blur) ? blur : 0;
  return a.from.every((x, axis) => Math.abs(x - b.from[axis]!) <= farthest || Object.is(x, b.from[axis]));
}

/** The cosine of the largest angle between two places, seen from the center, at which one may stand in for the other. */
const STAND_IN = Math.cos((2 * Math.PI) / 180);

/** A map is made for a camera that turns by so many degrees at most. */
const TURNS = 15;

/** The directions that a camera sees when it turns a little. */
export function widened(cone: Directions | undefined): Directions | undefined {
  return cone && { ...cone, angle: Math.min(cone.angle + 2 * TURNS, 360) };
}

/**
 * The directions of the picture of a camera that looks `along`, by its projection, by columns. Undefined where that tells no
 * opening.
 */
export function coneOf(projection: ArrayLike<number>, along: readonly number[]): Directions | undefined {
  const p = projection;
  // The corners of the picture are the directions (x, y, -1) in the camera's space.
  const [x, y] = [(1 + Math.abs(p[8]!)) / p[0]!, (1 + Math.abs(p[9]!)) / p[5]!];
  const angle = (2 * Math.atan(Math.hypot(x, y)) * 180) / Math.PI;
  const length = Math.hypot(...along);
  return angle > 0 && length > 0 ? { direction: along.map((part) => part / length), angle } : undefined;
}

/** Whether `b` has directions that are not in the {@link widened} `a`. */
export function isTurned(a: Directions | undefined, b: Directions | undefined): boolean {
  if (a === undefined || b === undefined) return a !== undefined;
  const cosine = cosineOf(a.direction, b.direction);
  return (Math.acos(Math.min(Math.max(cosine, -1), 1)) * 180) / Math.PI + (b.angle - a.angle) / 2 > TURNS;
}

/** Whether a picture from `a` is too different to be shown at `b`. */
export function isFarFrom(a: Place, b: Place, center: readonly number[]): boolean {
  const [p, q] = [a, b].map(({ from }) => from.map((x, axis) => x - center[axis]!)) as [number[], number[]];
  return a.isDirection !== b.isDirection || cosineOf(p, q) < STAND_IN;
}

function cosineOf(a: readonly number[], b: readonly number[]): number {
  return a.reduce((sum, x, axis) => sum + x * b[axis]!, 0) / (Math.hypot(...a) * Math.hypot(...b));
}
