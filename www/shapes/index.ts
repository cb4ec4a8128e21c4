import type { LoadedCloud } from "../cloud.ts";
import { makeRings } from "./rings.ts";
import { makeRoom } from "./room.ts";

/** The clouds that the page generates. */
export const SHAPES = { room: makeRoom, rings: makeRings } satisfies Record<string, () => LoadedCloud>;

export type ShapeName = keyof typeof SHAPES;
