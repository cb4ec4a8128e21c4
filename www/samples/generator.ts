import type { LoadedCloud } from "../cloud/cloud.ts";
import type { Mesh } from "./mesh.ts";
import type { Solid } from "./trace.ts";

/** A module that makes a sample: the same points on every machine. */
export interface Generator {
  make: () => LoadedCloud;
  /** The surface that the points were taken from. Some samples have none. */
  truth?: () => Truth;
}

/**
 * A surface, and for each point of the cloud its place on it. The points are the vertices of the mesh, or lie on its
 * faces, or lie on the solids of a scene. Rays can be traced in this scene.
 */
export type Truth = { mesh: Mesh; on: OnFaces | null } | { scene: Solid<unknown>; places: Float64Array };

/** Points on a mesh that are not its vertices, each with the number of the face it lies on. */
export interface OnFaces {
  positions: Float32Array;
  faces: Uint32Array;
}
