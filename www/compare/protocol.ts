import type { Parts } from "../view/parts.ts";
import type { KnownSurface } from "../samples/samples.ts";
import type { Picture } from "./zbuffer.ts";

/**
 * A message from the page to a worker with a reference. The cloud is sent in pieces, so that the page never stops. Then
 * the page asks one question at a time.
 */
export type Told<Question> =
  | { kind: "points"; count: number; at: number; points: Float32Array }
  | { kind: "ask"; question: Question }
  | { kind: "stop" };

export type Reply<Answer> =
  | { kind: "progress"; fraction: number }
  | { kind: "answer"; answer: Answer }
  | { kind: "stopped" }
  | { kind: "problem"; sentence: string };

export interface PictureQuestion {
  picture: Picture;
  /** The width of a splat in pixels, or the spacing of the cloud if the worker chooses the width. */
  splat: number | { spacing: number };
  /** Our answer. */
  visible: Uint32Array;
}

export interface PictureAnswer {
  parts: Parts;
  splat: number;
  /** The number of points in the picture, and the number of points that the z-buffer shows. */
  inside: number;
  visible: number;
  /** The time of the z-buffer alone. */
  milliseconds: number;
}

export interface TruthQuestion {
  surface: KnownSurface;
  viewpoint: [number, number, number];
  visible: Uint32Array;
  /** The answer of one hull, if ours is another one. */
  hull: Uint32Array | null;
}

/** How many points an answer shows although they are hidden, and hides although they are visible. */
export interface Errors {
  wrong: number;
  missed: number;
}

export interface TruthAnswer {
  parts: Parts;
  /** The number of points that can be seen. */
  visible: number;
  /** The errors of the one hull, if it was given. */
  hull: Errors | null;
  /** The time of the rays alone, without the preparation of the cloud. */
  milliseconds: number;
}
