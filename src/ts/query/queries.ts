import type { CameraNumbers, Seat } from "./camera.js";
import type { ResolvedInversion, SurfaceKind } from "./option-types.js";
import type { ViewSettings } from "./view-options.js";

/**
 * The questions to a cloud, by kind, and their answers. The arguments are read, copied and checked for type. Their
 * points have the core's number of coordinates (see `coreDimension`).
 */
export interface Questions {
  visibleFrom: { viewpoint: number[]; settings: ViewSettings; answer: Found };
  visibilityMap: {
    viewpoint: [number, number, number];
    settings: ViewSettings;
    /** The choices in the order of src/wasm/outputs.rs. */
    map: Float64Array<ArrayBuffer>;
    /** The camera of `towards`, of which the core makes the cone. */
    camera?: CameraNumbers | undefined;
    answer: {
      data: Float32Array<ArrayBuffer>;
      viewpoint: [number, number, number];
      center: [number, number, number];
      origin: [number, number, number];
      numbers: [number, number, number, number];
    };
  };
  panorama: {
    viewpoint: number[];
    settings: ViewSettings;
    width: number;
    height: number;
    up: number[];
    answer: Panorama & { ranges: Float32Array<ArrayBuffer>; indices: Uint32Array<ArrayBuffer> };
  };
  visibleFromDirection: { direction: number[]; settings: ViewSettings; answer: Found };
  /** Asks for points visible from at least `k` of the viewpoints. These are stored one after another. */
  visibleFromSeveral: { viewpoints: Float64Array<ArrayBuffer>; k: number; settings: ViewSettings; answer: Found };
  /** The same, where some seats are cameras. */
  visibleFromSeats: { seats: Seat[]; k: number; settings: ViewSettings; answer: Found };
  /** `camera` as `readCamera` lists it. */
  visibleFromCamera: {
    camera: Float64Array<ArrayBuffer>;
    settings: ViewSettings;
    /** Whether the answer has `towards`. */
    towards?: boolean;
    answer: Photographed;
  };
  /** `positions` have the core's number of coordinates. The answer has one byte for each position. */
  sees: {
    viewpoint: number[];
    positions: Float64Array;
    settings: ViewSettings;
    answer: { seen: Uint8Array<ArrayBuffer> };
  };
  autoRadius: { viewpoint: number[]; settings: ViewSettings; answer: ChosenRadius };
  noise: { answer: { noise: number } };
  /** The stations: the viewpoint of each, the indices of all of them, and where those of each end. */
  calibrate: {
    viewpoints: Float64Array<ArrayBuffer>;
    ends: Uint32Array<ArrayBuffer>;
    indices: Uint32Array<ArrayBuffer>;
    /** The lengths of the masks that stations were given by. */
    masks: (number | undefined)[];
    settings: ViewSettings;
    answer: { thickness: number; recall: number[]; shown: number; isLow: boolean };
  };
  surface: { answer: { surface: SurfaceKind } };
  reconstruct: {
    viewpoint: number[];
    settings: ViewSettings;
    maxEdge: number | undefined;
    answer: Found & { triangles: Uint32Array<ArrayBuffer> };
  };
  illuminate: {
    lights: Float64Array<ArrayBuffer>;
    settings: ViewSettings;
    triangles: Uint32Array<ArrayBuffer> | undefined;
    smoothing: number;
    ambient: number;
    answer: { brightness: Float32Array<ArrayBuffer> };
  };
}

export type QueryKind = keyof Questions;
/** `argument`: which of several viewpoints or cameras it is about, for errors. */
export type Query<K extends QueryKind = QueryKind> = {
  [P in K]: { kind: P; argument?: string } & Omit<Questions[P], "answer">;
}[K];

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
export type Answers = { [K in QueryKind]: Questions[K]["answer"] };

/** What stands in each direction around a viewpoint, row after row from up to down. */
export interface Panorama {
  /** The distance to the surface in each direction, in the cloud's units; `Infinity` for the sky. */
  ranges: Float32Array;
  /** The visible point that is nearest by angle; 2³² − 1 for the sky. */
  indices: Uint32Array;
  /** The share of the sky in the upper half of the sphere, weighted by the cosine from up: 0 to 1. */
  skyViewFactor: number;
  /** How much of the sphere is surface, in steradians. */
  solidAngle: number;
}
