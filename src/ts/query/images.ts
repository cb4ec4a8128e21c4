import { describe, HprError } from "../base/errors.js";
import { isNumberArray, type NumberArray, plainNumbers, typedArrayType } from "../base/typed-arrays.js";
import type { CameraNumbers } from "./camera.js";

/** An image, row by row from above: colors (an `ImageData`), a mask of labels, or rows of features. */
export interface TransferImage {
  /** As many numbers for each pixel as there are channels. */
  data: NumberArray;
  /** The size of its camera's image. */
  width: number;
  height: number;
  /** Default: as many as `data` has for each pixel. */
  channels?: number | undefined;
}

export interface Image {
  data: NumberArray;
  width: number;
  height: number;
  /** In images of 4 bytes a pixel, alpha 0 gives no value. */
  hasAlpha: boolean;
}

/** Writes the value of an image at a place into an array. Returns whether there is one. */
export function valueAt(image: Image, channels: number, u: number, v: number, into: Float64Array): boolean {
  return pixel(image, channels, Math.floor(u), Math.floor(v), into);
}

/** Between the centers of four pixels. Those without a value do not count. */
export function valueBetween(image: Image, channels: number, u: number, v: number, into: Float64Array): boolean {
  const [x, y] = [Math.floor(u - 0.5), Math.floor(v - 0.5)];
  const [right, down] = [u - 0.5 - x, v - 0.5 - y];
  const sum = new Float64Array(channels);
  let total = 0;
  for (const [i, j] of [
    [0, 0],
    [1, 0],
    [0, 1],
    [1, 1],
  ] as const) {
    // prettier-ignore
    const weight = (i === 0 ? 1 - right : right) * (j === 0 ? 1 - down : down);
    if (weight > 0 && pixel(image, channels, x + i, y + j, into)) {
      for (let c = 0; c < channels; c++) sum[c]! += weight * into[c]!;
      total += weight;
    }
  }
  for (let c = 0; c < channels; c++) into[c] = sum[c]! / total;
  return total > 0;
}

/** A pixel, or the nearest one of the image. Returns whether it has a value. */
function pixel(image: Image, channels: number, column: number, row: number, into: Float64Array): boolean {
  const x = Math.min(Math.max(column, 0), image.width - 1);
  const y = Math.min(Math.max(row, 0), image.height - 1);
  const from = (y * image.width + x) * channels;
  if (image.hasAlpha && image.data[from + 3] === 0) return false;
  for (let c = 0; c < channels; c++) {
    into[c] = image.data[from + c]!;
    if (Number.isNaN(into[c])) return false;
  }
  return true;
}

/** The images, one for each camera. */
export function readImages(images: unknown, lenses: readonly CameraNumbers[]): { images: Image[]; channels: number } {
  if (!Array.isArray(images) || images.length !== lenses.length) {
    const got = Array.isArray(images) ? `${images.length} of them` : describe(images);
    throw new HprError(
      "option",
      `images must be an array of one image for each of ${lenses.length} cameras, got ${got}`,
    );
  }
  let channels: number | undefined;
  const own = Array.from(images, (given: unknown, i): Image => {
    const wrong = (problem: string) => new HprError("option", `images[${i}] ${problem}`);
    if (typeof given !== "object" || given === null) throw wrong(`must be an image, got ${describe(given)}`);
    const { data, width = NaN, height = NaN, channels: said } = given as Partial<TransferImage>;
    const [, , , , wide, high] = lenses[i]!.subarray(16);
    if (!Number.isInteger(width) || !Number.isInteger(height) || width !== wide || height !== high) {
      throw wrong(
        `must have the size of its camera's image, ${wide} × ${high}, got ${describe(width)} × ${describe(height)}`,
      );
    }
    const numbers = isNumberArray(data) ? plainNumbers(data) : undefined;
    if (numbers === undefined) {
      throw wrong(`must have a typed array of numbers as data, not transferred away, got ${describe(data)}`);
    }
    const each = said ?? numbers.length / (width * height);
    if (!Number.isInteger(each) || each < 1 || each * width * height !== numbers.length) {
      throw wrong(`must have the same number of numbers for each of ${width * height} pixels, got ${numbers.length}`);
    }
    channels ??= each;
    if (each !== channels) throw wrong(`must have ${channels} channels as the first one, got ${each}`);
    const isBytes = ["Uint8Array", "Uint8ClampedArray"].includes(typedArrayType(numbers)!);
    return { data: numbers, width, height, hasAlpha: each === 4 && isBytes };
  });
  return { images: own, channels: channels ?? 1 };
}
