import type { Up } from "../../src/ts/formats/axes.js";
import type { FileStation } from "../../src/ts/formats/cloud-file.js";
import type { Values } from "../../src/ts/formats/numbers.js";
import type { Crs, Unit } from "../../src/ts/formats/las/crs.js";
import type { LasSource } from "../../src/ts/formats/las/details.js";

export type { FileStation, Up, Values };

/** A number for each point, for example its intensity, its class or its time. */
export interface Attribute {
  name: string;
  /** Categories are a few whole numbers whose order means nothing. */
  kind: "scalar" | "category";
  values: Values;
  /** The meaning of a category's numbers, if it is known. */
  labels?: Readonly<Record<number, string>>;
  /** The colors of a category's numbers, if they have an order. */
  colors?: Readonly<Record<number, string>>;
}

/** The result of a loader: the file's own coordinates, and its colors (sRGB bytes), if it has any. */
export interface LoadedCloud {
  positions: Float32Array | Float64Array;
  colors: Uint8Array | null;
  attributes?: Attribute[];
  /** All columns besides positions and colors in bytes. If this is missing, they are the attributes. */
  fields?: Field[];
  facts?: FileFacts;
  /** The index of each point in the file, if some points of the file are left out. */
  origin?: Uint32Array;
  /** Whether the points are the rows and columns of a picture. Then points without a position are usual. */
  isGrid?: boolean;
  /** Sentences about the cloud that the user has to read. */
  notes?: string[];
  /** The columns of a table that were taken for x, y and z, if other ones may have been meant. */
  columnsAt?: readonly number[];
  /** How the cloud was measured, if the file says so: the direction that was up, and the places of the scanner. */
  taken?: { up?: Up; stations?: FileStation[] };
}

/** A cloud ready to draw: recentered in f32 for the graphics card. The file's own coordinates go to the hull's worker. */
export interface Cloud {
  count: number;
  colors: Uint8Array | null;
  attributes: readonly Attribute[];
  /** All columns of the file besides positions and colors in bytes. */
  fields: readonly Field[];
  facts: FileFacts;
  /** The index of each point in the file. `null`: all points of the file are there. */
  origin: Uint32Array | null;
  /** Center of the bounding box in the file's coordinates; local = file − center. */
  center: [number, number, number];
  local: Float32Array;
  /** Width, height and depth of the bounding box, and half its diagonal. */
  size: [number, number, number];
  radius: number;
  /** The box of nearly all points, if the others lie far away from them: its middle in `local`, and its size. */
  body: { middle: [number, number, number]; size: [number, number, number] } | null;
  spacing: Spacing;
}

/** A cloud ready to draw, with the file's own coordinates and the loader's words about it. */
export interface PreparedCloud extends Pick<LoadedCloud, "positions" | "notes" | "columnsAt" | "taken"> {
  cloud: Cloud;
  /** A copy of the positions for the hull's worker, which keeps what it gets. */
  copy: Float32Array | Float64Array;
}

export function upVector(up: Up): [number, number, number] {
  return up === "z" ? [0, 0, 1] : [0, up === "y" ? 1 : -1, 0];
}

export type { Crs, LasSource, Unit };
export { valueAt } from "../../src/ts/formats/numbers.js";

/** A column of the file: a number for each point, or a single number that all points share. */
export interface Field {
  name: string;
  values: Values;
  /** The meaning of a category's numbers, if it is known. */
  labels?: Readonly<Record<number, string>>;
}

/** What a file says about its numbers. */
export interface FileFacts {
  /** The decimals of x, y and z, if the file gives them. */
  decimals?: [number, number, number];
  crs?: Crs;
  las?: LasSource;
  /** How many columns of the file are not kept, because they would take too much memory. */
  dropped?: number;
}

/** How far apart the points of a cloud are: typically, and near each point. */
export interface Spacing {
  typical: number;
  /** One byte a point, never 0: `typical` · 2 ^ ((byte − 128) / 32). */
  local: Uint8Array<ArrayBuffer>;
}
