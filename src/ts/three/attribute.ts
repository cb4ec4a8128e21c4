import type { BufferAttribute, GLBufferAttribute, InterleavedBufferAttribute } from "three";

import { allocating, describe, HprError } from "../base/errors.js";
import { isFloatArray } from "../query/positions.js";
import { typedArrayType } from "../base/typed-arrays.js";

export type PositionAttribute = BufferAttribute | InterleavedBufferAttribute;

/** The positions of a geometry's points: x, y, z of one point after another. */
export interface ReadPositions {
  numbers: Float32Array | Float64Array;
  /** Whether the numbers are a copy. Then their memory may be given away. Otherwise, it is the attribute's. */
  own: boolean;
}

/** Types whose values are all exact in single precision. Integers of 32 bits are not exact. */
const EXACT_IN_SINGLE = ["Float32Array", "Int8Array", "Uint8Array", "Uint8ClampedArray", "Int16Array", "Uint16Array"];

/** Refuses a geometry whose positions cannot be read here. */
export function requirePositions(
  attribute: PositionAttribute | GLBufferAttribute | undefined | null,
): PositionAttribute {
  if (typeof attribute !== "object" || attribute === null) {
    throw new HprError("positions-type", "the geometry has no attribute named position");
  }
  if ("isGLBufferAttribute" in attribute) {
    throw new HprError("positions-type", "position is a GLBufferAttribute: its numbers are on the graphics card alone");
  }
  const { itemSize, getX, count, array } = attribute as Partial<PositionAttribute>;
  if (typedArrayType(array) === undefined || array!.length < itemSize! * count!) {
    throw new HprError("positions-type", `the array of position is gone or too short, got ${describe(array)}`);
  }
  if (!(itemSize! >= 3) || typeof getX !== "function") {
    throw new HprError(
      "positions-type",
      `position must be a THREE.BufferAttribute with an itemSize of 3, got ${describe(itemSize)}`,
    );
  }
  return attribute;
}

/** A number that grows with every `needsUpdate = true`. */
export function versionOf(attribute: PositionAttribute): number {
  return "data" in attribute ? attribute.data.version : attribute.version;
}

/**
 * Reads the positions of the points with these numbers, or of all points. They are read as three
 * itself reads them: `normalized` integers are divided, and the result is in double precision.
 * `place` has the elements of a matrix. If it is given, the positions are transformed by it, also
 * in double precision.
 */
export function readPositions(
  attribute: PositionAttribute,
  ids: Uint32Array | undefined,
  place?: readonly number[],
): ReadPositions {
  const { array, normalized, itemSize, count } = attribute;
  const packed = !("data" in attribute) && itemSize === 3 && !normalized;
  if (packed && ids === undefined && place === undefined && isFloatArray(array)) {
    return { numbers: array.subarray(0, 3 * count), own: false };
  }
  const length = ids?.length ?? count;
  const single = !normalized && place === undefined && EXACT_IN_SINGLE.includes(typedArrayType(array)!);
  const numbers = allocating(`${length} points`, () => new (single ? Float32Array : Float64Array)(3 * length));
  for (let i = 0, to = 0; i < length; i++, to += 3) {
    const id = ids === undefined ? i : ids[i]!;
    numbers[to] = attribute.getX(id);
    numbers[to + 1] = attribute.getY(id);
    numbers[to + 2] = attribute.getZ(id);
  }
  if (place !== undefined) movePoints(numbers, place);
  return { numbers, own: true };
}

/** Transforms points by a matrix. If this is only a translation, the result is one addition per coordinate. */
function movePoints(numbers: Float32Array | Float64Array, m: readonly number[]): void {
  for (let i = 0; i < numbers.length; i += 3) {
    const x = numbers[i]!;
    const y = numbers[i + 1]!;
    const z = numbers[i + 2]!;
    for (let axis = 0; axis < 3; axis++) {
      numbers[i + axis] = m[axis]! * x + m[4 + axis]! * y + m[8 + axis]! * z + m[12 + axis]!;
    }
  }
}
