import type { PointCloud } from "./cloud.js";
import { describe, HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { isNumberArray, type NumberArray, plainNumbers, typedArrayType } from "../base/typed-arrays.js";
import type { Camera, CameraNumbers } from "../query/camera.js";
import { givenOptions, pick } from "../query/options.js";
import { MAX_LENGTH } from "../query/positions.js";
import { COVERAGE_OPTIONS, type CoverageOptions, readListener } from "../query/surveys.js";
import { readCameras } from "../query/seats.js";
import { refuseDraftAndScores, VIEW_OPTIONS, type VisibilityOptions } from "../query/view-options.js";
import { MERGES, type Merge, merged } from "./merge-values.js";

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

export interface TransferOptions extends CoverageOptions {
  /**
   * How the values of several cameras become one: the weighted `"median"` (default) or `"mean"` of each
   * channel, the pixel with the most weight among equal ones (`"vote"`, for labels), or that of the camera with
   * the highest weight (`"best"`).
   */
  merge?: Merge | undefined;
  /**
   * How much a camera counts: 1 ÷ the square of the depth, the cosine of the angle between the ray and the optical
   * axis, or the score of the view (needs looks). Default: all the same; for `"best"`, `"distance"`.
   */
  weights?: "distance" | "angle" | "score" | undefined;
  /** The nearest pixel (default), or `"bilinear"`: between the four pixels around; not with `"vote"`. */
  sampling?: "nearest" | "bilinear" | undefined;
}

/** What images say about the points of a cloud. */
export interface Transferred {
  /** `channels` numbers for each index, in the images' own scale; NaN where `seen` is 0. */
  values: Float32Array<ArrayBuffer>;
  channels: number;
  /** How many cameras gave a value, for each index. */
  seen: Uint32Array<ArrayBuffer>;
}

const WEIGHTS = ["distance", "angle", "score"] as const;
const SAMPLINGS = ["nearest", "bilinear"] as const;
const OWN_OPTIONS = ["merge", "weights", "sampling"] as const;

interface Image {
  data: NumberArray;
  width: number;
  height: number;
  /** In images of 4 bytes a pixel, alpha 0 gives no value. */
  hasAlpha: boolean;
}

/** The entries of one camera: the points, where they are in the image, and how much they count. */
interface Entries {
  indices: Uint32Array;
  pixels: Float32Array;
  weights: Float32Array;
}

/**
 * Takes values from images to points: colors, labels, or features. A point has a value from each camera that sees it;
 * what no camera sees is NaN. Unless `looks`, `radius`, `exponent` or `inversion` is given, three looks decide.
 *
 * @param images one for each camera, all with the same number of channels. A pixel with a NaN gives no value, nor one
 *   with alpha 0 in an image of 4 bytes a pixel.
 * @throws HprError `option` for images and options, `viewpoint` for cameras, `too-large`; otherwise as
 *   `PointCloud.visibleFromCamera`.
 */
export function transfer(
  cloud: PointCloud,
  cameras: readonly Camera[],
  images: readonly TransferImage[],
  options?: TransferOptions,
): Transferred {
  const given = givenOptions(options, COVERAGE_OPTIONS, OWN_OPTIONS);
  const merge = word(given, "merge", MERGES) ?? "median";
  const sampling = word(given, "sampling", SAMPLINGS) ?? "nearest";
  const weigh = word(given, "weights", WEIGHTS) ?? (merge === "best" ? "distance" : undefined);
  if (merge === "vote" && sampling === "bilinear") {
    throw new HprError("option", "sampling bilinear cannot be combined with merge vote");
  }
  refuseDraftAndScores(given, "transfer");
  const lenses = readCameras(cameras);
  const { own, channels } = readImages(images, lenses);
  const onProgress = readListener(given);
  const view: VisibilityOptions = { ...pick(given, VIEW_OPTIONS), scores: weigh === "score" };
  const isChosen = ["looks", "radius", "exponent", "inversion"].some((name) => given[name] !== undefined);
  if (!isChosen) view.looks = 3;

  const views = lenses.map((lens, i): Entries => {
    const { indices, pixels, depths, scores } = cloud.visibleFromCamera(cameras[i]!, view);
    const weights = depths.map((depth, k) => {
      if (weigh === "distance") return 1 / (depth * depth);
      if (weigh === "score") return scores![indices[k]!]!;
      if (weigh === undefined) return 1;
      const [x, y] = [(pixels[2 * k]! - lens[18]!) / lens[16]!, (pixels[2 * k + 1]! - lens[19]!) / lens[17]!];
      return 1 / Math.hypot(1, x, y);
    });
    onProgress?.((i + 1) / lenses.length);
    return { indices, pixels, weights };
  });
  const read = sampling === "nearest" ? nearest : bilinear;
  return joined(cloud.length, channels, views, (number, at, into) => read(own[number]!, channels, at, into), merge);
}

/** Writes the value of an image at a pixel into an array. Returns whether there is one. */
type Reader = (number: number, at: readonly [number, number], into: Float64Array) => boolean;

/** Merges the values of each point. */
function joined(length: number, channels: number, views: Entries[], read: Reader, merge: Merge): Transferred {
  if (length * channels > MAX_LENGTH) {
    throw new HprError("too-large", `${length * channels} values exceed the limit of ${MAX_LENGTH}`);
  }
  const [values, seen, next] = allocating(`${length} values of ${channels} channels`, () => [
    new Float32Array(length * channels).fill(NaN),
    new Uint32Array(length),
    views.map(() => 0),
  ]);
  const rows = views.map(() => new Float64Array(channels));
  const weights = new Float64Array(views.length);
  const target = new Float64Array(channels);
  for (let index = 0; index < length; index++) {
    let count = 0;
    views.forEach((view, number) => {
      const k = next[number]!;
      if (view.indices[k] !== index) return;
      next[number] = k + 1;
      if (!read(number, [view.pixels[2 * k]!, view.pixels[2 * k + 1]!], rows[count]!)) return;
      weights[count] = view.weights[k]!;
      count += 1;
    });
    seen[index] = count;
    if (count > 0) {
      merged(merge, rows, weights, count, target);
      values.set(target, index * channels);
    }
  }
  return { values, channels, seen };
}

function nearest(image: Image, channels: number, [u, v]: readonly [number, number], into: Float64Array): boolean {
  return pixel(image, channels, Math.floor(u), Math.floor(v), into);
}

/** Between the centers of four pixels. Those without a value do not count. */
function bilinear(image: Image, channels: number, [u, v]: readonly [number, number], into: Float64Array): boolean {
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

function readImages(images: unknown, lenses: readonly CameraNumbers[]): { own: Image[]; channels: number } {
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
  return { own, channels: channels ?? 1 };
}

function word<T extends string>(given: Record<string, unknown>, name: string, words: readonly T[]): T | undefined {
  const value = given[name];
  if (value !== undefined && !words.includes(value as T)) {
    throw new HprError("option", `${name} must be one of ${words.join(", ")}, got ${describe(value)}`);
  }
  return value as T | undefined;
}
