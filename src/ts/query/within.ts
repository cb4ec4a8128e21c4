import { describe, HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import { entriesOf, number, requireLow } from "./options.js";
import type { Within } from "./option-types.js";

export type { Within };

/** {@link Within}, checked for type, as the core reads it. */
export interface WithinSettings {
  /** The distance, and the lowest and the highest coordinates. Infinity stands for none. */
  within: readonly number[];
  mask: Uint8Array<ArrayBuffer> | undefined;
}

export const ALL_POINTS: WithinSettings = { within: numbers(), mask: undefined };

/** Reads the option `within`. The core checks the ranges. */
export function withinSettings(within: unknown, dimension: number): WithinSettings {
  if (within === undefined) {
    return ALL_POINTS;
  }
  requireLow("within", dimension);
  const given = entriesOf("within", within, ["distance", "box", "mask"]);
  const distance = number(given, "distance");
  const { box, mask } = given;
  return {
    within: numbers(distance, box === undefined ? undefined : readBox(box, dimension)),
    mask: mask === undefined ? undefined : readMask(mask),
  };
}

function numbers(distance = Infinity, { min, max }: { min: number[]; max: number[] } = { min: [], max: [] }): number[] {
  // A missing coordinate, also the z of a plane, has no limit.
  const fill = (corner: number[], limit: number) => [0, 1, 2].map((axis) => corner[axis] ?? limit);
  return [distance, ...fill(min, -Infinity), ...fill(max, Infinity)];
}

function readBox(box: unknown, dimension: number): { min: number[]; max: number[] } {
  const [min, max] = (listOf(box, 2) ?? []).map((corner) => listOf(corner, dimension));
  const areNumbers = (list?: unknown[]): list is number[] => list?.every((x) => typeof x === "number") === true;
  if (!areNumbers(min) || !areNumbers(max)) {
    throw new HprError("option", `within box must be [min, max], each with ${dimension} numbers, got ${describe(box)}`);
  }
  if (!min.every((least, axis) => least <= max[axis]!)) {
    const got = `${min.join(", ")} and ${max.join(", ")}`;
    throw new HprError(
      "option",
      `within box must be [min, max], where no coordinate of min is above that of max, got ${got}`,
    );
  }
  return { min, max };
}

/** The entries of a list of this length: nothing is read of a longer one, or of one whose memory is gone. */
function listOf(value: unknown, length: number): unknown[] | undefined {
  if (typeof value !== "object" || value === null || !("length" in value) || value.length !== length) return undefined;
  return Array.from({ length }, (_, i) => (value as ArrayLike<unknown>)[i]);
}

/** A copy, so that later changes do not concern a request that waits. The core checks the length. */
function readMask(mask: unknown): Uint8Array<ArrayBuffer> {
  const bytes = typedArrayType(mask) === "Uint8Array" ? plainView(mask as Uint8Array, Uint8Array) : undefined;
  if (bytes === undefined) {
    throw new HprError("option", `within mask must be a Uint8Array, not transferred away, got ${describe(mask)}`);
  }
  return allocating(`a mask of ${bytes.length} bytes`, () => bytes.slice());
}
