import { indicesByStation } from "../../src/ts/formats/stations.js";
import type { Opened } from "../view/viewer.ts";

/** A place from which points were measured, and these points: it surely sees them. */
export interface Measured {
  viewpoint: [number, number, number];
  indices: Uint32Array;
}

/** The stations of a scan that have measured points. */
export function measuredBy({
  cloud,
  positions,
  stations,
}: Pick<Opened, "cloud" | "positions" | "stations">): Measured[] {
  return indicesByStation({ stations, columns: cloud.fields, positions })
    .map((indices, i) => ({ viewpoint: stations[i]!.viewpoint, indices }))
    .filter(({ indices }) => indices.length > 0);
}
