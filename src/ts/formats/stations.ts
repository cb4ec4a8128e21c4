import type { CloudFile } from "./cloud-file.js";
import { type Column, type FilledColumn, valueAt } from "./column.js";

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
