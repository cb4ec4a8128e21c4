import { numberIn } from "../../formats/numbers.js";
import { FormatProblem, lineProblem } from "../../formats/problem.js";
import { lines, type Source } from "../../formats/source.js";
import { looksBinary, trimmed } from "../../formats/text.js";
import { type ImageCamera, CAMERA_MODELS, type CameraModel, type Intrinsics } from "../../query/camera.js";

/** A camera, and the image that it has taken. */
export interface CameraOfImage {
  camera: ImageCamera;
  /** The name of the image as the file gives it. */
  image: string;
}

/** The size of images in pixels, for files that do not say it. */
export interface ImageSize {
  width: number;
  height: number;
}

/** One line of a file. */
export interface TextLine {
  /** Without blanks at its ends. */
  text: string;
  raw: string;
  /** Counted from 1. */
  number: number;
}

export async function* textLines(source: Source): AsyncGenerator<TextLine> {
  if (looksBinary(await source.read(0, 4096))) throw new FormatProblem("it is not text");
  for await (const { texts, number } of lines(source, 0)) {
    for (const [i, text] of texts.entries()) yield { text: trimmed(text), raw: text, number: number + i };
  }
}

/** Finite numbers of a line. */
export function numbersIn(words: readonly string[], line: number, field: string): number[] {
  return words.map((word) => {
    const number = numberIn(word);
    if (number === undefined || !Number.isFinite(number)) {
      throw lineProblem(line, `has no finite number for ${field}`, word);
    }
    return number;
  });
}

/** @param refuse gets what is wrong with a field */
export function checked<T extends Intrinsics>(intrinsics: T, refuse: (says: string) => Error): T {
  for (const name of ["fx", "fy", "width", "height"] as const) {
    const value = intrinsics[name];
    if (!(value > 0 && value < Infinity)) throw refuse(`has ${value} for ${name}, which must be finite and positive`);
  }
  for (const value of [intrinsics.cx, intrinsics.cy, ...Array.from(intrinsics.distortion ?? [])]) {
    if (!Number.isFinite(value)) throw refuse(`has ${value} for cx, cy or the distortion, which must be finite`);
  }
  return intrinsics;
}

/** Whether COLMAP's model has one focal length, not two. */
const HAS_ONE_FOCAL = /^(SIMPLE_|RADIAL)/;

/** How many numbers COLMAP lists for a model: focal lengths, principal point, distortion. */
export function parametersOf(model: CameraModel): number {
  return (HAS_ONE_FOCAL.test(model) ? 3 : 4) + CAMERA_MODELS[model];
}

/** The lens of COLMAP's parameters. */
export function lensOf(model: CameraModel, { width, height }: ImageSize, parameters: readonly number[]): Intrinsics {
  const [fx, fy, cx, cy, ...distortion] = HAS_ONE_FOCAL.test(model) ? [parameters[0]!, ...parameters] : parameters;
  return { fx: fx!, fy: fy!, cx: cx!, cy: cy!, width, height, model, distortion };
}
