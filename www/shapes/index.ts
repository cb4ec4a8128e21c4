import type { LoadedCloud } from "../cloud.ts";

/** The clouds that the page generates, each downloaded when it is wanted. */
export const SHAPES = {
  room: async () => (await import("./room.ts")).makeRoom(),
  rings: async () => (await import("./rings.ts")).makeRings(),
} satisfies Record<string, () => Promise<LoadedCloud>>;

export type ShapeName = keyof typeof SHAPES;
