import type { Parts } from "../view/parts.ts";
import type { KnownSurface } from "../samples/samples.ts";
import type { Picture } from "./zbuffer.ts";

/** What the page tells a worker that holds a reference: the cloud, in pieces so that sending it holds nothing up, then questions one at a time. */
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
  /** The width of a point's splat in pixels, or from which spacing of the cloud it is to be chosen. */
  splat: number | { spacing: number };
  /** Our answer. */
  visible: Uint32Array;
}

export interface PictureAnswer {
  parts: Parts;
  splat: number;
  /** Points in the picture, and how many of them the z-buffer shows. */
  inside: number;
  visible: number;
  /** Of the z-buffer alone. */
  milliseconds: number;
}

export interface TruthQuestion {
  surface: KnownSurface;
  viewpoint: [number, number, number];
  visible: Uint32Array;
}

export interface TruthAnswer {
  parts: Parts;
  /** Points that can be seen. */
  visible: number;
  /** Of the rays alone, without what is made once for a cloud. */
  milliseconds: number;
}
