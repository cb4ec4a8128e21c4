import type { WasmModule } from "../instance/compile.js";
import type { ChosenColumns, Up } from "./axes.js";
import type { Crs, Unit } from "./las/crs.js";
import type { LasSource } from "./las/details.js";
import { type FilledColumn, type Column, valueAt } from "./numbers.js";
import type { Source } from "./source.js";

/** What files hold, by the ending of their names. `.gz` may stand behind it. The ending of COPC is .copc.laz. */
export const ENDINGS = {
  las: "las", laz: "las", e57: "e57", ptx: "ptx", ply: "ply", pcd: "pcd", xyz: "table", txt: "table", csv: "table",
  pts: "table", asc: "table", obj: "obj", gltf: "gltf", glb: "gltf", npy: "array", bin: "array",
} as const; // prettier-ignore

export type Format = (typeof ENDINGS)[keyof typeof ENDINGS];

export type Place = [x: number, y: number, z: number];

/** A place from which points of a file were measured. */
export interface FileStation {
  name: string;
  viewpoint: Place;
}

/** A file to read, and how. */
export interface Reading {
  source: Source;
  /** The name of the file. Its ending tells the format if the first bytes do not. */
  name: string;
  /** The most points that are kept. If there are more, every so many-th is kept. */
  limit?: number | undefined;
  /** The columns that are x, y and z, if the file's own names do not count. */
  chosen?: ChosenColumns | undefined;
  /** Whether a file that contradicts itself is read, as far as that is possible. */
  damaged?: boolean | undefined;
  /** Whether the bytes of each point are wanted. Then there is no limit. */
  records?: boolean | undefined;
  /** Whether columns of text are kept in single precision. */
  single?: boolean | undefined;
  /** Reads a file in the folder of a glTF file, in which its other files are. Without it, they cannot be read. */
  beside?: ((name: string) => Promise<Uint8Array<ArrayBuffer>>) | undefined;
  /** Compiles the wasm that reads E57 and LAZ. */
  wasm?: (() => Promise<WasmModule>) | undefined;
  signal?: AbortSignal | undefined;
  /** The progress from 0 to 1. */
  onProgress?: ((fraction: number) => void) | undefined;
}

/** The bytes of each point. They are known if they were asked for. */
export interface Records {
  /** They are elsewhere than in the file, if the file is compressed. */
  bytes: Uint8Array | undefined;
  start: (index: number) => number;
  end: (index: number) => number;
}

/** The contents of a file. */
export interface CloudFile {
  /** x, y, z of one point after another, in the precision of the file. */
  positions: Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;
  columns: FilledColumn[];
  /** Colors in bytes that the file keeps in one number for each point. */
  packed?: Uint8Array<ArrayBuffer>;
  /** The number of points in the file. */
  rows: number;
  /** The names of columns that are no single numbers, and so not among the others. */
  unread?: string[];
  /** Sentences without a period that a user has to read. */
  notes: string[];
  /** In words: which columns are x, y and z, if their names do not say so. */
  axes?: string | undefined;
  /** The numbers of these columns in a table, counted from 1. */
  columnsAt?: readonly number[];
  /** Whether these columns are obvious for a person who looks at the file. */
  areAxesPlain?: boolean;
  /** Whether the points are the rows and columns of a picture. Then points without a position are usual. */
  isGrid?: boolean;
  up?: Up;
  /** The places from which the points were measured. If there are several, a column `SCAN` says which. */
  stations?: FileStation[];
  crs?: Crs | undefined;
  /** The unit of its format. */
  unit?: Unit;
  las?: LasSource;
  records: Records;
}

/** The number of each point's scan, from 0. */
export const SCAN = { name: "scan", type: "uint16" } as const satisfies Column;

/** The columns of a cloud whose first one is `SCAN`. It goes if there is one scan. */
export function scanColumns([scan, ...others]: FilledColumn[], names: readonly string[]): FilledColumn[] {
  return names.length > 1 ? [{ ...scan!, labels: Object.fromEntries(names.entries()) }, ...others] : others;
}

interface Measured {
  stations?: CloudFile["stations"];
  columns: readonly Pick<FilledColumn, "name" | "values">[];
  positions: ArrayLike<number>;
}

/** The points of each station: those that have a position. */
export function indicesByStation({ stations = [], columns, positions }: Measured): Uint32Array[] {
  if (stations.length === 0) return [];
  const scans = columns.find(({ name }) => name === SCAN.name);
  const found = stations.map((): number[] => []);
  for (let i = 0; i < positions.length / 3; i++) {
    const isThere = [0, 1, 2].every((axis) => Number.isFinite(positions[3 * i + axis]));
    if (isThere) found[stations.length > 1 ? valueAt(scans!, i) : 0]!.push(i);
  }
  return found.map((indices) => Uint32Array.from(indices));
}
