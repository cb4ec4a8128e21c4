import { describe, HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import type { Answers } from "./answers.js";
import { givenOptions, requireSpace } from "./options.js";
import { readIndices, readViewpoint, type Viewpoint } from "./positions.js";
import type { Query } from "./queries.js";
import { refuseScores, VIEW_OPTIONS, viewSettings, type VisibilityOptions } from "./view-options.js";

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
  /** In the cloud's units. */
  readonly thickness: number;
  /**
   * For each station, the share of its own points that `options` see, from 0 to 1. Points that cannot be seen do not
   * count: removed and skipped ones, and those outside of `within`.
   */
  readonly recall: number[];
  /** Of the points that a station did not measure and does not see with a thickness of 0, the share that it sees with this one. */
  readonly shown: number;
  /** The given options with `looks` and this `thickness`. */
  readonly options: VisibilityOptions;
  /** Says so if the stations see less than 90 % of their own points. */
  readonly note?: string;
}

/** Reads the stations of a cloud of so many indices, and the options, which look three times by default. */
export function calibrationQuery(
  { dimension, length }: { dimension: number; length: number },
  stations: unknown,
  options: unknown,
): { query: Query<"calibrate">; answer: (found: Answers["calibrate"]) => Calibration } {
  requireSpace("calibrate", dimension);
  const given: VisibilityOptions = { looks: 3, ...givenOptions(options, VIEW_OPTIONS) };
  refuseScores(given, "calibrate");
  const settings = viewSettings({ ...given }, dimension);
  const own = readStations(stations, length);
  const ends = own.reduce<number[]>((ends, { indices }) => [...ends, (ends.at(-1) ?? 0) + indices.length], []);
  const indices = allocating(`${ends.at(-1)} indices`, () => new Uint32Array(ends.at(-1)!));
  own.forEach((station, i) => indices.set(station.indices, ends[i]! - station.indices.length));
  const viewpoints = Float64Array.from(own.flatMap(({ viewpoint }) => readViewpoint(viewpoint, 3)));
  const query = { kind: "calibrate" as const, viewpoints, ends: Uint32Array.from(ends), indices, settings };
  const answer = ({ thickness, recall, shown, isLow }: Answers["calibrate"]): Calibration => {
    const mean = recall.reduce((sum, share) => sum + share, 0) / recall.length;
    const seen = Math.floor(100 * mean);
    const note = `the stations see ${seen} % of their own points: more thickness would show more hidden points than own ones`;
    return { thickness, recall, shown, options: { ...given, thickness }, ...(isLow && { note }) };
  };
  return { query, answer };
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
