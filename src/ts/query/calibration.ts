import { describe, HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import { givenOptions } from "./options.js";
import { readIndices, type Viewpoint } from "./positions.js";
import { VIEW_OPTIONS, type VisibilityOptions } from "./view-options.js";

/** Where a scanner stood, and the points that it measured, by exactly one of `indices` and `mask`. */
export interface Station {
  viewpoint: Viewpoint;
  /** The indices of its points. */
  indices?: ArrayLike<number> | undefined;
  /** One byte for each index of the cloud: not 0 for its points. */
  mask?: Uint8Array | undefined;
}

/** How a cloud is to be asked, so that its scanners see the points that they measured. */
export interface Calibration {
  /** The smallest thickness that was found, in the cloud's units. */
  readonly thickness: number;
  /** For each station, the share of its own points that `options` see, from 0 to 1. */
  readonly recall: number[];
  /** The given options with `looks` and this `thickness`. */
  readonly options: VisibilityOptions;
}

/** So many of the points of each station must be seen. */
const ENOUGH = 0.985;
/** The first thickness, in spacings, how often it is doubled at most, and how often halves are tried then. */
const FIRST = 1 / 8;
const DOUBLINGS = 16;
const HALVINGS = 3;

/** A view that a calibration needs. It goes on with the mask of its answer. */
export interface TrialView {
  viewpoint: Viewpoint;
  options: VisibilityOptions;
}

/** Looks for the smallest thickness at which each station sees its own points. */
export function* calibration(
  { length, spacing }: { length: number; spacing: number },
  stations: unknown,
  options: unknown,
): Generator<TrialView, Calibration, Uint8Array> {
  const given: VisibilityOptions = { looks: 3, ...givenOptions(options, VIEW_OPTIONS) };
  const own = readStations(stations, length);

  function* tried(thickness: number): Generator<TrialView, Calibration, Uint8Array> {
    const trial = { ...given, thickness };
    const recall: number[] = [];
    for (const { viewpoint, indices } of own) {
      const mask = yield { viewpoint, options: trial };
      recall.push(indices.reduce((seen, index) => seen + mask[index]!, 0) / indices.length);
    }
    return { thickness, recall, options: trial };
  }
  const isEnough = ({ recall }: Calibration) => recall.every((share) => share >= ENOUGH);

  if (typeof given.thickness === "number" || spacing === 0) {
    return yield* tried(typeof given.thickness === "number" ? given.thickness : 0);
  }
  let best = yield* tried(FIRST * spacing);
  let least = 0;
  for (let k = 0; k < DOUBLINGS && !isEnough(best); k++) {
    least = best.thickness;
    best = yield* tried(2 * best.thickness);
  }
  for (let k = 0; k < HALVINGS && least > 0 && isEnough(best); k++) {
    const between = yield* tried(Math.sqrt(least * best.thickness));
    if (isEnough(between)) best = between;
    else least = between.thickness;
  }
  return best;
}

function readStations(stations: unknown, length: number) {
  if (!Array.isArray(stations) || stations.length === 0) {
    throw new HprError("option", `stations must be an array of at least one station, got ${describe(stations)}`);
  }
  return Array.from(stations, (station: unknown, i) => {
    const name = `stations[${i}]`;
    if (typeof station !== "object" || station === null) {
      throw new HprError(
        "option",
        `${name} must be { viewpoint, indices } or { viewpoint, mask }, got ${describe(station)}`,
      );
    }
    const { viewpoint, indices, mask } = station as Station;
    if ((indices === undefined) === (mask === undefined)) {
      throw new HprError("option", `${name} must have one of indices and mask`);
    }
    const own = mask === undefined ? readIndices(indices) : marked(mask, length, name);
    const stray = own.find((index) => index >= length);
    if (own.length === 0 || stray !== undefined) {
      const problem = stray === undefined ? "has no points" : `has index ${stray}, which must be below ${length}`;
      throw new HprError("option", `${name} ${problem}`);
    }
    return { viewpoint, indices: own };
  });
}

function marked(mask: unknown, length: number, name: string): Uint32Array {
  const bytes = typedArrayType(mask) === "Uint8Array" ? plainView(mask as Uint8Array, Uint8Array) : undefined;
  if (bytes?.length !== length) {
    throw new HprError("option", `${name}: the mask must be a Uint8Array of ${length} bytes, got ${describe(mask)}`);
  }
  const count = bytes.reduce((sum, byte) => sum + Number(byte !== 0), 0);
  const indices = allocating(`${count} indices`, () => new Uint32Array(count));
  let next = 0;
  bytes.forEach((byte, index) => {
    if (byte !== 0) indices[next++] = index;
  });
  return indices;
}
