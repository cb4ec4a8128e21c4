import type { ResolvedInversion } from "./view-options.js";

/** How a radius was chosen. */
export interface ChosenRadius {
  /**
   * R, the radius of the flipping sphere in the cloud's units; 0 where no point
   * is away from the viewpoint. With an inversion by power its unit S, with an
   * exponential one 0.
   */
  readonly radius: number;
  /** log₁₀(R ÷ farthest distance), the paper's parameter; 0 where there is no R. */
  readonly exponent: number;
  /** Hulls computed to choose R, the final one not counted. */
  readonly evaluations: number;
}

/** What is visible, with the length of the cloud that was asked. */
export interface Found extends ChosenRadius {
  indices: Uint32Array<ArrayBuffer>;
  inversion: ResolvedInversion;
  exact: boolean;
  length: number;
  /** Where they were asked for. */
  scores?: Float32Array<ArrayBuffer>;
}

/** The answers, by kind of query. */
export interface Answers {
  visibleFrom: Found;
  visibleFromDirection: Found;
  visibleFromSeveral: Found;
  autoRadius: ChosenRadius;
  reconstruct: Found & { triangles: Uint32Array<ArrayBuffer> };
  illuminate: { brightness: Float32Array<ArrayBuffer> };
}
