import { describe, HprError } from "../base/errors.js";
import type { ChosenColumns as Chosen } from "../formats/axes.js";
import { type CloudFile, indicesByStation } from "../formats/cloud-file.js";
import { displayColors } from "../formats/colors.js";
import type { Crs, Unit } from "../formats/las/crs.js";
import type { Values } from "../formats/numbers.js";
import { readFile } from "../formats/read.js";
import type { InitInput } from "../instance/compile.js";
import { flag, givenOptions, listener } from "../query/options.js";
import { readSignal, reasonOf } from "../worker/abort.js";
import { type FileSource, refusal, sourceOf } from "./source-of.js";
import { compiler } from "./wasm.js";

/** The columns that are x, y and z: their names, or their numbers from 1. */
export type ChosenColumns = readonly [string | number, string | number, string | number];

/** How a file is read. */
export interface ReadOptions {
  /** Ends the reading, which then rejects with an `AbortError`. */
  signal?: AbortSignal | undefined;
  /** Takes the share of the file that has been read, from 0 to 1. */
  onProgress?: ((fraction: number) => void) | undefined;
  /** The columns of a table, PLY or PCD that are x, y and z. Default: those that the file's own names say. */
  columns?: ChosenColumns | undefined;
  /** Whether a file that contradicts itself is read as far as possible, with a note. Default false: it is refused. */
  damaged?: boolean | undefined;
  /** The wasm that reads E57 and LAZ, if the file that comes with the package cannot be found: its address or its bytes. */
  wasm?: InitInput | undefined;
}

/** A place from which points of a file were measured. */
export interface Station {
  viewpoint: [number, number, number];
  indices: Uint32Array;
}

/** The points of a file. */
export interface CloudData {
  /** x, y, z of one point after another. Single precision if the file's own numbers have no more. */
  positions: Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;
  /** Red, green and blue of each point in bytes (sRGB), if the file has colors. */
  colors?: Uint8Array<ArrayBuffer>;
  /** All other numbers of each point, by their names in the file. */
  columns: Record<string, Values>;
  /** The coordinate reference system, if the file names one. */
  crs?: Crs;
  /** The unit of the coordinates, if the file names one. */
  unit?: Unit;
  /** The places from which the points were measured, if the file says so. */
  stations?: Station[];
  /** Sentences that a person should read, for example how a damaged file contradicts itself. */
  notes?: string[];
}

/**
 * Reads LAS, LAZ, COPC, E57, PTX, PLY, PCD, tables (XYZ, TXT, CSV), OBJ and glTF. The first bytes show the format; if they
 * do not, the ending of the name does. Points keep the order of the file. A coordinate that a file does not have is NaN.
 *
 * @param source a Blob, an ArrayBuffer, a Uint8Array, a URL, or a string: a path in Node, an address in browsers
 * @throws HprError (as a rejection) `load` if the file cannot be read or contradicts itself; the message names the
 * line or the fault. `option` for a wrong source or option.
 */
export async function readCloud(source: FileSource, options: ReadOptions = {}): Promise<CloudData> {
  const { signal, ...settings } = readSettings(options);
  if (signal?.aborted) throw reasonOf(signal);
  const { close, ...named } = await sourceOf(source, signal);
  try {
    return cloudData(await readFile({ ...named, ...settings, signal }));
  } catch (cause) {
    if (signal?.aborted) throw reasonOf(signal);
    throw refusal(named.name, cause);
  } finally {
    await close();
  }
}

function readSettings(options: unknown) {
  const given = givenOptions(options, ["signal", "onProgress", "columns", "damaged", "wasm"]);
  const { columns } = given;
  return {
    signal: readSignal(given["signal"]),
    onProgress: listener(given, "onProgress") as ReadOptions["onProgress"],
    chosen: columns === undefined ? undefined : chosenColumns(columns),
    damaged: flag(given, "damaged"),
    wasm: compiler(given["wasm"]),
  };
}

function chosenColumns(columns: unknown): Chosen {
  const isChoice = (each: unknown) =>
    typeof each === "number" ? Number.isInteger(each) && each > 0 : typeof each === "string" && each !== "";
  const chosen = Array.isArray(columns) ? (columns as unknown[]) : [];
  if (chosen.length !== 3 || !chosen.every(isChoice) || new Set(chosen.map(String)).size < 3) {
    throw new HprError("option", `columns must be three different names or numbers from 1, got ${describe(columns)}`);
  }
  return chosen.map(String) as unknown as Chosen;
}

function cloudData(file: CloudFile): CloudData {
  const { positions, crs, packed, notes, axes, areAxesPlain, stations = [], unread = [] } = file;
  const channels = ["red", "green", "blue"].map((name) => file.columns.find((column) => column.name === name)?.values);
  const [red, green, blue] = channels;
  const colors = packed ?? (red && green && blue ? displayColors([red, green, blue]) : null);
  const unit = crs?.unit ?? file.unit;
  const found = indicesByStation(file).map((indices, i) => ({ viewpoint: stations[i]!.viewpoint, indices }));
  const measured = found.filter(({ indices }) => indices.length > 0);
  const lost = unread.length > 0 ? [`not read, since they are no single numbers: ${unread.join(", ")}`] : [];
  const said = [...notes, ...lost, ...(axes !== undefined && areAxesPlain !== true ? [axes] : [])];
  return {
    positions,
    ...(colors && { colors }),
    columns: named(file.columns),
    ...(crs && { crs }),
    ...(unit && { unit }),
    ...(measured.length > 0 && { stations: measured }),
    ...(said.length > 0 && { notes: said }),
  };
}

/** Columns by their names. Of several with one name, the later ones get numbers. */
function named(columns: CloudFile["columns"]): Record<string, Values> {
  const found = new Map<string, Values>();
  for (const { name, values } of columns) {
    let free = name;
    for (let number = 2; found.has(free); number++) free = `${name} ${number}`;
    found.set(free, values);
  }
  return Object.fromEntries(found);
}
