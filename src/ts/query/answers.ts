import type { ResolvedInversion, SurfaceKind } from "./option-types.js";

/** How a radius was chosen. */
export interface ChosenRadius {
  /**
   * R, the radius of the flipping sphere, in the cloud's units. It is 0 if no point is away from
   * the viewpoint. With an inversion by power, this is its unit S. With an exponential inversion,
   * this is 0.
   */
  readonly radius: number;
  /** log₁₀(R ÷ farthest distance), the paper's parameter. It is 0 if there is no R. */
  readonly exponent: number;
  /** The number of hulls computed to choose R, without the final hull. */
  readonly evaluations: number;
}

/** The visible points, with the length of the cloud. */
export interface Found extends ChosenRadius {
  indices: Uint32Array<ArrayBuffer>;
  inversion: ResolvedInversion;
  exact: boolean;
  length: number;
  /** Undefined unless the option `scores` asked for them. */
  scores?: Float32Array<ArrayBuffer>;
  /** Whether the pose of a camera was probably given the wrong way round. */
  inverted?: boolean;
}

/** The visible points in an image. */
export interface Photographed extends Found {
  pixels: Float32Array<ArrayBuffer>;
  depths: Float32Array<ArrayBuffer>;
  /** The directions of length 1 from the points to the camera, if the query asked for them. */
  towards?: Float32Array<ArrayBuffer>;
}

/** The answers, by kind of query. */
export interface Answers {
  visibleFrom: Found;
  visibleFromDirection: Found;
  visibleFromSeveral: Found;
  visibleFromSeats: Found;
  visibleFromCamera: Photographed;
  /** One byte for each position. */
  sees: { seen: Uint8Array<ArrayBuffer> };
  autoRadius: ChosenRadius;
  noise: { noise: number };
  calibrate: { thickness: number; recall: number[]; shown: number; isLow: boolean };
  surface: { surface: SurfaceKind };
  visibilityMap: {
    data: Float32Array<ArrayBuffer>;
    viewpoint: [number, number, number];
    center: [number, number, number];
    origin: [number, number, number];
    numbers: [number, number, number, number];
  };
  panorama: {
    ranges: Float32Array<ArrayBuffer>;
    indices: Uint32Array<ArrayBuffer>;
    skyViewFactor: number;
    solidAngle: number;
  };
  reconstruct: Found & { triangles: Uint32Array<ArrayBuffer> };
  illuminate: { brightness: Float32Array<ArrayBuffer> };
}
