import type { LoadedCloud } from "../cloud/cloud.ts";
import type { CloudFile, Reading } from "../../src/ts/formats/cloud-file.js";
import { attributesOf } from "./attributes.ts";

/** The file to read, the largest number of points to keep, and the listener for the progress. */
export interface Loading extends Pick<Reading, "name" | "onProgress" | "beside"> {
  blob: Blob;
  limit: number;
  damaged?: boolean | undefined;
  chosen?: Reading["chosen"];
}

const MOST_DECIMALS = 12;

/** What the page keeps of a file. */
export function loaded(name: string, file: CloudFile): LoadedCloud {
  const { positions, notes, axes, areAxesPlain, columnsAt, isGrid, up, stations, crs, las } = file;
  const { facts, ...known } = attributesOf(file);
  return {
    positions,
    ...known,
    facts: { ...facts, ...(las && { las, ...decimalsOf(las) }), ...(crs && { crs }) },
    notes: [...(axes !== undefined && areAxesPlain === false ? [`${name}: ${axes}.`] : []), ...notes.map(sentence)],
    ...(columnsAt && areAxesPlain === false && { columnsAt }),
    ...(isGrid && { isGrid }),
    ...((up ?? stations) && { taken: { ...(up && { up }), ...(stations && { stations }) } }),
  };
}

function sentence(note: string): string {
  return `${note[0]!.toUpperCase()}${note.slice(1)}.`;
}

/** The decimals that every coordinate has: those of the scale and of the offset. */
export function decimalsOf({
  scale,
  offset,
}: Record<"scale" | "offset", readonly number[]>): { decimals: [number, number, number] } | Record<string, never> {
  const decimals = scale.map((step, axis) => Math.max(decimalsIn(step), decimalsIn(offset[axis]!)));
  // A scale such as 1/3 has no end. Then the coordinates are shown with all digits.
  return decimals.every((count) => count <= MOST_DECIMALS) ? { decimals: decimals as [number, number, number] } : {};
}

function decimalsIn(value: number): number {
  const [digits, exponent = "0"] = String(Math.abs(value)).split("e");
  return Math.max(0, (digits!.split(".")[1]?.length ?? 0) - Number(exponent));
}
