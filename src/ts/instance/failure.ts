import { HprError, type HprErrorCode } from "../base/errors.js";

/**
 * A refusal as the wasm throws it: its name, and the option and the numbers for its message
 * (src/wasm/failure.rs). The message is written here, because text in the wasm would make it
 * larger.
 */
interface Failure {
  code: HprErrorCode;
  problem: keyof typeof MESSAGES;
  option: string;
  /** Another option, or what is wanted of this one. */
  other: string;
  numbers: [number, number, number];
}

/** The same messages as those of the crate's `Error`. */
const MESSAGES = {
  nonFinite: (count, first) =>
    `${count} point(s) have a coordinate that is NaN or infinite, the first at index ${first}`,
  viewpoint: (x, y, z) => `the viewpoint must be finite, got ${x}, ${y}, ${z}`,
  radiusInvalid: (radius) => `radius must be finite and positive, got ${radius}`,
  radiusTooSmall: (radius, farthest) =>
    `radius ${radius} is smaller than the distance of the farthest point, ${farthest}`,
  radiusOverflow: (radius, farthest) =>
    `radius must be at most 8.98e307, got ${radius} (an exponent e makes it ${farthest} * 10^e)`,
  distanceOverflow: (farthest) => `the farthest distance (${farthest}) exceeds the range of f64`,
  tooManyPoints: (count, limit) => `${count} points exceed the limit of ${limit}`,
  mergeRadius: () =>
    "merging needs the radius, in the cloud's units, or the exponential scale that all parts were seen with",
  idsLength: (part, positions, ids) => `part ${part} has ${positions} positions, but ${ids} ids`,
  indexOutOfRange: (index, length) => `index ${index} is out of range for a cloud of length ${length}`,
  outOfMemory: () => "not enough memory for this cloud",
  disposed: () => "this cloud has been disposed of",
  parameter: (value, _b, _c, option, wanted) => `${option} must be ${wanted}, got ${value}`,
  excludes: (_a, _b, _c, option, other) => `${option} cannot be combined with ${other}`,
  outOfRange: (least, most, value, option) => `${option} must be from ${least} to ${most}, got ${value}`,
  camera: (value, _b, _c, problem) => `the camera's ${problem}, got ${value}`,
  boundsInvalid: () => "a box must be [min, max], where no coordinate of min is above that of max",
  maskLength: (given, length) => `within mask must have one element for each of ${length} indices, got ${given}`,
  dimension: (dimension, _b, _c, option) => `${option} needs a cloud of dimension 3, not ${dimension}`,
  direction: (x, y, z) => `the direction must be finite and not zero, got ${x}, ${y}, ${z}`,
  viewpointDimension: (dimension) => `the viewpoint must be ${dimension} finite numbers`,
  positionsLength: (length, dimension) => `${length} coordinates are not a multiple of the dimension, ${dimension}`,
} satisfies Record<string, Words>;

type Words = (...named: [first: string, second: string, third: string, option: string, other: string]) => string;

/**
 * The error of a refusal by the bindings, which have freed their memory by then. Undefined for any
 * other thrown value.
 */
export function refusal(thrown: unknown): HprError | undefined {
  if (!isFailure(thrown)) {
    return undefined;
  }
  const [a, b, c] = thrown.numbers;
  const words: Words = MESSAGES[thrown.problem];
  return new HprError(thrown.code, words(spelled(a), spelled(b), spelled(c), thrown.option, thrown.other));
}

/** The core's error for points that are not finite. */
export function nonFinite(count: number, first: number): HprError {
  return new HprError("non-finite", MESSAGES.nonFinite(String(count), String(first)));
}

/** The number as the crate writes it. JavaScript writes only these cases differently. */
function spelled(number: number): string {
  if (Object.is(number, -0)) {
    return "-0";
  }
  return String(number).replace("Infinity", "infinity").replace("e+", "e");
}

function isFailure(thrown: unknown): thrown is Failure {
  return (
    typeof thrown === "object" &&
    thrown !== null &&
    !(thrown instanceof Error) &&
    "code" in thrown &&
    "problem" in thrown &&
    "numbers" in thrown
  );
}
