import { describe, HprError, typeTag } from "./errors.js";
import { allocating } from "./memory.js";

/**
 * Coordinates of points, x, y, z after one another. A Float32Array is kept in
 * single precision, everything else in double. Views of a SharedArrayBuffer are
 * welcome. The positions are always copied.
 */
export type Positions = Float32Array | Float64Array | ArrayLike<number>;

/** A 32-bit memory cannot address more. */
export const MAX_LENGTH = 2 ** 32 - 1;

/** Positions in a form that wasm can copy from: the caller's own typed array, or a new one. */
export function readPositions(positions: unknown, stride: number): Float32Array | Float64Array {
  const numbers = isFloatArray(positions) ? positions : fromArrayLike(positions);
  if (numbers.length > MAX_LENGTH) {
    throw new HprError("too-large", `${numbers.length} coordinates exceed the limit of ${MAX_LENGTH}`);
  }
  if (numbers.length % stride !== 0) {
    throw new HprError(
      "positions-length",
      `expected ${stride} numbers for each point, got ${numbers.length}, which is not a multiple of ${stride}`,
    );
  }
  return numbers;
}

/** A viewpoint's three coordinates. Whether they are finite is the core's to check. */
export function readViewpoint(viewpoint: unknown): [number, number, number] {
  if (!isArrayLike(viewpoint) || viewpoint.length !== 3) {
    const got = isArrayLike(viewpoint) ? `${viewpoint.length} of them` : describe(viewpoint);
    throw new HprError("viewpoint", `the viewpoint must be 3 numbers, got ${got}`);
  }
  const [x, y, z] = [viewpoint[0], viewpoint[1], viewpoint[2]];
  if (typeof x !== "number" || typeof y !== "number" || typeof z !== "number") {
    throw new HprError(
      "viewpoint",
      `the viewpoint must be 3 numbers, got ${describe(x)}, ${describe(y)}, ${describe(z)}`,
    );
  }
  return [x, y, z];
}

/** Indices of points to remove, copied. Whether the cloud has them is the core's to check. */
export function readIndices(indices: unknown): Uint32Array<ArrayBuffer> {
  if (!isArrayLike(indices)) {
    throw new HprError("option", `indices must be an array of integers, got ${describe(indices)}`);
  }
  const { length } = indices;
  const integers = allocating(`${length} indices`, () => new Uint32Array(length));
  for (let i = 0; i < length; i++) {
    const index = indices[i];
    if (typeof index !== "number" || index >>> 0 !== index) {
      throw new HprError("option", `indices[${i}] must be the index of a point, got ${describe(index)}`);
    }
    integers[i] = index;
  }
  return integers;
}

export function isFloatArray(value: unknown): value is Float32Array | Float64Array {
  const tag = typeTag(value);
  return ArrayBuffer.isView(value) && (tag === "Float32Array" || tag === "Float64Array");
}

function fromArrayLike(positions: unknown): Float64Array {
  if (ArrayBuffer.isView(positions) || !isArrayLike(positions)) {
    throw new HprError(
      "positions-type",
      `positions must be a Float32Array, a Float64Array or an array of numbers, got ${describe(positions)}`,
    );
  }
  const { length } = positions;
  const numbers = allocating(`${length} coordinates`, () => new Float64Array(length));
  for (let i = 0; i < numbers.length; i++) {
    const number = positions[i];
    if (typeof number !== "number") {
      throw new HprError("positions-type", `positions[${i}] must be a number, got ${describe(number)}`);
    }
    numbers[i] = number;
  }
  return numbers;
}

function isArrayLike(value: unknown): value is ArrayLike<unknown> {
  return (
    typeof value === "object" &&
    value !== null &&
    "length" in value &&
    Number.isSafeInteger(value.length) &&
    (value.length as number) >= 0
  );
}
