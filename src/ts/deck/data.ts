import { createIterable } from "@deck.gl/core";

import { HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { isFloatArray } from "../query/positions.js";

/** Data that deck.gl calls binary: attributes instead of objects. */
export interface BinaryData {
  length: number;
  attributes: Record<string, unknown>;
}

interface BinaryAttribute {
  value: ArrayLike<number>;
  size?: number;
  /** The distance from one point to the next, in bytes. */
  stride?: number;
  offset?: number;
}

type GetPosition = (object: unknown, info: { index: number; data: unknown; target: number[] }) => ArrayLike<number>;

export function isBinary(data: unknown): data is BinaryData {
  return typeof data === "object" && data !== null && "attributes" in data && "length" in data;
}

/** The positions of a layer's data: x, y, z of one point after another. The data may be binary or objects. */
export function positionsOf(data: unknown, getPosition: unknown): Float32Array | Float64Array {
  if (isBinary(data) && "getPosition" in data.attributes) {
    return fromAttribute(data.attributes["getPosition"] as BinaryAttribute | ArrayLike<number>, data.length);
  }
  if (typeof getPosition !== "function") {
    throw new HprError(
      "positions-type",
      "the layer's data has no positions: neither getPosition nor an attribute of that name",
    );
  }
  const { iterable, objectInfo } = createIterable(data);
  const numbers: number[] = [];
  for (const object of iterable) {
    objectInfo.index += 1;
    const [x = 0, y = 0, z = 0] = Array.from((getPosition as GetPosition)(object, objectInfo));
    numbers.push(x, y, z);
  }
  return Float64Array.from(numbers);
}

function fromAttribute(attribute: BinaryAttribute | ArrayLike<number>, length: number): Float32Array | Float64Array {
  const { value, size = 3, stride, offset = 0 } = "value" in attribute ? attribute : { value: attribute };
  if (!isFloatArray(value)) {
    throw new HprError(
      "positions-type",
      "the attribute getPosition must have a Float32Array or Float64Array as its value",
    );
  }
  const [step, start] = [
    (stride ?? size * value.BYTES_PER_ELEMENT) / value.BYTES_PER_ELEMENT,
    offset / value.BYTES_PER_ELEMENT,
  ];
  if (step === 3 && size === 3) return value.subarray(start, start + 3 * length);
  const numbers = allocating(
    `${length} points`,
    () => new (value.BYTES_PER_ELEMENT === 4 ? Float32Array : Float64Array)(3 * length),
  );
  for (let i = 0; i < length; i++) {
    for (let axis = 0; axis < Math.min(size, 3); axis++) numbers[3 * i + axis] = value[start + i * step + axis]!;
  }
  return numbers;
}
