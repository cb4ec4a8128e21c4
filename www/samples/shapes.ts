import type { LoadedCloud } from "../cloud/cloud.ts";

/** The clouds that the page generates, each downloaded when it is wanted. */
export const SHAPES = {
  room: async () => (await import("./living-room.ts")).makeRoom(),
  rings: async () => (await import("./rings.ts")).makeRings(),
  street: async () => (await import("./street.ts")).makeStreet(),
  tile: async () => (await import("./tile.ts")).makeTile(),
} satisfies Record<string, () => Promise<LoadedCloud>>;

export type ShapeName = keyof typeof SHAPES;
