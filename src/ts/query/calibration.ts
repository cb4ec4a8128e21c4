import { allocating, describe, HprError } from "../base/errors.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import type { Answers, Query } from "./queries.js";
import { VIEW_ROWS } from "./option-rows.js";
import { ownOf, requireSpace, type Rows } from "./options.js";
import { readIndices, readViewpoint, refuseMask, type Viewpoint } from "./positions.js";
import { refuseScores, VIEW_OPTIONS, viewSettings, type VisibilityOptions } from "./view-options.js";

/** Where a scanner stood, and the points that it measured, by exactly one of `indices` and `mask`. */
export type Station = {
  /** x, y, z in the cloud's units. */
  viewpoint: Viewpoint;
} & (
  | {
      /** The indices of its points. */
      indices: ArrayLike<number>;
      mask?: undefined;
    }
  | {
      indices?: undefined;
      /** One byte for each index of the cloud: not 0 for its points. */
      mask: Uint8Array;
    }
);

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

/** The options of a view. They look three times by default, so what needs looks may stand alone. */
export const CALIBRATION_ROWS = Object.fromEntries(
  Object.entries(VIEW_ROWS).map(([name, row]) => [name, { ...row, needs: undefined }]),
) satisfies Rows;

/** @param given the options, which look three times by default */
export function calibrationQuery(dimension: number, stations: unknown, given: object): Query<"calibrate"> {
  requireSpace("calibrate", dimension);
  refuseScores(given, "calibrate");
  const settings = viewSettings(looking(given), dimension);
  const own = readStations(stations);
  const ends = own.reduce<number[]>((ends, { indices }) => [...ends, (ends.at(-1) ?? 0) + indices.length], []);
  const indices = allocating(`${ends.at(-1)} indices`, () => new Uint32Array(ends.at(-1)!));
  own.forEach((station, i) => indices.set(station.indices, ends[i]! - station.indices.length));
  const viewpoints = Float64Array.from(own.flatMap(({ viewpoint }) => readViewpoint(viewpoint, 3)));
  const masks = own.map(({ length }) => length);
  return { kind: "calibrate", viewpoints, ends: Uint32Array.from(ends), indices, masks, settings };
}

export function calibrationAnswer(
  { thickness, recall, shown, isLow }: Answers["calibrate"],
  given: Record<string, unknown>,
): Calibration {
  const mean = recall.reduce((sum, share) => sum + share, 0) / recall.length;
  const seen = Math.floor(100 * mean);
  const note = `the stations see ${seen} % of their own points: more thickness would show more hidden points than own ones`;
  const options = Object.assign(looking(given), { thickness });
  return { thickness, recall, shown, options, ...(isLow && { note }) };
}

/** The options of a view among them, with three looks unless they say otherwise. */
function looking(given: object): VisibilityOptions {
  const own = Object.entries(given).filter(([name]) => VIEW_OPTIONS.includes(name));
  // Without a prototype: what somebody added to that is no option.
  return Object.assign(Object.create(null) as VisibilityOptions, { looks: 3 }, Object.fromEntries(own));
}

/** Refuses stations without points, and those whose masks or indices do not fit a cloud of so many indices. */
export function checkStations({ masks, ends, indices }: Query<"calibrate">, length: number): void {
  masks.forEach((bytes, i) => {
    if (bytes === undefined) {
      refuseMask(indices.subarray(ends[i - 1] ?? 0, ends[i]), length, `stations[${i}]: `);
    } else if (bytes !== length) {
      throw new HprError("option", `stations[${i}]: the mask must be a Uint8Array of ${length} bytes, got ${bytes}`);
    }
  });
  const empty = ends.findIndex((end, i) => end === (i === 0 ? 0 : ends[i - 1]));
  if (empty >= 0) throw new HprError("option", `stations[${empty}] has no points`);
  const stray = indices.findIndex((index) => index >= length);
  if (stray < 0) return;
  const station = ends.findIndex((end) => end > stray);
  const problem = `has index ${indices[stray]}, which must be below ${length}`;
  throw new HprError("option", `stations[${station}] ${problem}`);
}

/** The stations; also the length of a mask. */
function readStations(stations: unknown): { viewpoint: unknown; indices: Uint32Array; length: number | undefined }[] {
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
    const [viewpoint, indices, mask] = ["viewpoint", "indices", "mask"].map((part) => ownOf(station, part));
    if ((indices === undefined) === (mask === undefined)) {
      throw new HprError("option", `${name} must have one of indices and mask`);
    }
    const bytes = mask === undefined ? undefined : readMask(mask, name);
    const own = bytes === undefined ? readIndices(indices) : marked(bytes);
    return { viewpoint, indices: own, length: bytes?.length };
  });
}

function readMask(mask: unknown, name: string): Uint8Array {
  const bytes = typedArrayType(mask) === "Uint8Array" ? plainView(mask as Uint8Array, Uint8Array) : undefined;
  if (bytes !== undefined) return bytes;
  throw new HprError(
    "option",
    `${name}: the mask must be a Uint8Array with one byte for each index, not transferred away, got ${describe(mask)}`,
  );
}

function marked(bytes: Uint8Array): Uint32Array {
  const count = bytes.reduce((sum, byte) => sum + Number(byte !== 0), 0);
  const indices = allocating(`${count} indices`, () => new Uint32Array(count));
  let next = 0;
  bytes.forEach((byte, index) => {
    if (byte !== 0) indices[next++] = index;
  });
  return indices;
}
