import type { Found, Photographed } from "../query/queries.js";
import { allocating, describe, HprError } from "../base/errors.js";
import { isNumberArray, type NumberArray, plainNumbers, typedArrayType } from "../base/typed-arrays.js";
import { type Instance, requireInstance } from "../instance/instance.js";
import { type CameraNumbers, type ImageCamera, readCameras } from "../query/camera.js";
import { TRANSFER_ROWS, type TransferOptions } from "../query/option-rows.js";
import { type Checked, ownOf, requireSpace } from "../query/options.js";
import { MAX_LENGTH } from "../query/positions.js";
import { type CoverageOptions, type SeenBy, surveyed, SurveyTask } from "../query/surveys.js";
import { refuseScores, viewSettings } from "../query/view-options.js";
import { PointCloud } from "./cloud.js";
import { freeCloud } from "../instance/engine.js";

export type { TransferOptions };

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

/** What images say about the points of a cloud. */
export interface Transferred {
  /**
   * `channels` numbers for each index, in the images' own scale; NaN where `seen` is 0. A Float64Array if an image has
   * doubles or integers of 32 bits.
   */
  values: Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;
  channels: number;
  /** How many cameras gave a value, for each index. */
  seen: Uint32Array<ArrayBuffer>;
  /** What is probably wrong with a camera; see `Visibility.note`. */
  note?: string;
}

/** A `WorkerPointCloud`. */
interface InWorkers {
  seenBy(cameras: readonly ImageCamera[], options?: CoverageOptions): Promise<SeenBy>;
}

/**
 * Takes values from images to points: colors, labels, or features. A point has a value from each camera that sees it;
 * what no camera sees is NaN. Unless `looks`, `radius`, `exponent` or `inversion` is given, three looks decide.
 *
 * @param images one for each camera, all with the same number of channels. A pixel with a NaN gives no value, nor one
 *   with alpha 0 in an image of 4 bytes a pixel. Instead of an array, an iterable gives one image after another, each when
 *   its camera was asked, and none is kept.
 * @throws HprError `option` for images and options, `viewpoint` for cameras, `too-large`; otherwise as
 *   `PointCloud.visibleFromCamera`.
 */
export function transfer(
  cloud: PointCloud,
  cameras: readonly ImageCamera[],
  images: Iterable<TransferImage>,
  options?: TransferOptions,
): Transferred;
/** The same for a `WorkerPointCloud`: its workers share the cameras, and the images stay here. An array of them is copied. */
export function transfer(
  cloud: InWorkers,
  cameras: readonly ImageCamera[],
  images: Iterable<TransferImage>,
  options?: TransferOptions & { signal?: AbortSignal | undefined; latest?: boolean | undefined },
): Promise<Transferred>;
export function transfer(
  cloud: PointCloud | InWorkers,
  cameras: readonly ImageCamera[],
  images: Iterable<TransferImage>,
  options?: TransferOptions,
): Transferred | Promise<Transferred> {
  const ask = surveyed.get(cloud);
  if (ask === undefined) {
    throw new HprError("option", `transfer needs a PointCloud or a WorkerPointCloud, got ${describe(cloud)}`);
  }
  const copies = !(cloud instanceof PointCloud);
  return ask([
    "transfer",
    options,
    TRANSFER_ROWS,
    (dimension, given, progress) => new TransferTask(dimension, cameras, images, copies, given, progress),
  ]);
}

/** An image whose numbers the core can read. */
interface Image {
  data: NumberArray;
  channels: number;
}

/** Takes values from one image after another. The core holds the sums, and no image is kept. */
class TransferTask extends SurveyTask<Transferred> {
  override readonly usesWasm = true;
  readonly #cameras: readonly CameraNumbers[];
  readonly #images: Iterator<Image>;
  /** The words of the options, as the core numbers them. */
  readonly #how: [merge: number, weights: number, sampling: number];
  /** The views whose turn has not come. */
  readonly #views = new Map<number, Photographed>();
  #next = 0;
  #channels: number | undefined;
  #isDouble = false;
  #core: { instance: Instance; handle: number } | undefined;

  constructor(
    dimension: number,
    cameras: unknown,
    images: unknown,
    copies: boolean,
    given: Checked<TransferOptions, typeof TRANSFER_ROWS>,
    progress?: (fraction: number) => void,
  ) {
    const { merge = "mean", sampling = "nearest" } = given;
    const weigh = given.weights ?? (merge === "best" ? "distance" : undefined);
    if (merge === "vote" && sampling === "bilinear") {
      throw new HprError("option", "sampling bilinear cannot be combined with merge vote");
    }
    const isChosen = (["looks", "radius", "exponent", "inversion"] as const).some((name) => given[name] !== undefined);
    requireSpace("transfer", dimension);
    refuseScores(given, "transfer");
    const seats = readCameras(cameras);
    const read = readImages(images, seats, copies);
    const own = { ...(!isChosen && { looks: 3 }), scores: weigh === "score" };
    const asked = Object.assign(Object.create(null) as object, given, own);
    super({ seats, settings: viewSettings(asked, dimension), towards: weigh === "angle" }, progress);
    const { merge: merges, weights, sampling: samplings } = TRANSFER_ROWS;
    this.#cameras = seats;
    this.#images = read;
    this.#how = [
      merges.words.indexOf(merge),
      weigh === undefined ? 0 : 1 + weights.words.indexOf(weigh),
      samplings.words.indexOf(sampling),
    ];
  }

  /** Takes the views in the order of their cameras. */
  protected override add(number: number, found: Found): void {
    this.#views.set(number, found as Photographed);
    for (let view = this.#views.get(this.#next); view !== undefined; view = this.#views.get(this.#next)) {
      this.#views.delete(this.#next);
      this.#take(view);
      this.#next += 1;
    }
  }

  #take(view: Photographed): void {
    // The images throw where one is missing.
    const { data, channels } = this.#images.next().value as Image;
    if (view.length * channels > MAX_LENGTH) {
      throw new HprError("too-large", `${view.length * channels} values exceed the limit of ${MAX_LENGTH}`);
    }
    this.#channels = channels;
    const numbers = readable(data);
    this.#isDouble ||= numbers instanceof Float64Array;
    const { instance, handle } = this.#begun(view.length);
    instance.call((bindings) => {
      bindings.addImage(handle, this.#cameras[this.#next]!, view, numbers, channels);
    });
  }

  #begun(length: number): { instance: Instance; handle: number } {
    if (this.#core === undefined) {
      const instance = requireInstance();
      const { handle } = instance.call((bindings) => bindings.createTransfer(length, ...this.#how));
      this.#core = { instance, handle };
    }
    return this.#core;
  }

  /** @param length the length of the cloud */
  result(length: number): Transferred {
    this.#images.next();
    const channels = this.#channels ?? 1;
    const { instance, handle } = this.#begun(length);
    const [values, seen] = allocating(`${length} values of ${channels} channels`, () => [
      new (this.#isDouble ? Float64Array : Float32Array)(length * channels),
      new Uint32Array(length),
    ]);
    instance.call((bindings) => {
      bindings.writeValues(handle, values, seen);
    });
    return { values, channels, seen, ...this.noted };
  }

  override end(): void {
    if (this.#core !== undefined) freeCloud(this.#core);
    this.#images.return?.();
  }
}

/** The numbers in a type that the core reads. */
function readable(data: NumberArray): Uint8Array | Float32Array | Float64Array {
  const type = typedArrayType(data);
  if (type === "Uint8Array" || type === "Float32Array" || type === "Float64Array") {
    return data as Uint8Array | Float32Array | Float64Array;
  }
  if (type === "Uint8ClampedArray") return new Uint8Array(data.buffer, data.byteOffset, data.length);
  const Type = data.BYTES_PER_ELEMENT === 4 ? Float64Array : Float32Array;
  return allocating(`${data.length} numbers of an image`, () => Type.from(data));
}

/** The images, one for each camera. Those of an array are read and checked now, those of an iterable when they are asked for. */
function readImages(images: unknown, cameras: readonly CameraNumbers[], copies: boolean): Iterator<Image> {
  const given = images as Iterable<unknown> | null | undefined;
  if (typeof given !== "object" || typeof given?.[Symbol.iterator] !== "function") {
    throw wrongCount(cameras, describe(images));
  }
  if (!Array.isArray(given)) return imagesOf(given, cameras, false);
  if (given.length !== cameras.length) throw wrongCount(cameras, `${given.length} of them`);
  return [...imagesOf(given, cameras, copies)].values();
}

function* imagesOf(given: Iterable<unknown>, cameras: readonly CameraNumbers[], copies: boolean): Generator<Image> {
  let count = 0;
  let channels: number | undefined;
  for (const image of given) {
    if (count === cameras.length) throw wrongCount(cameras, "more");
    const own = readImage(image, `images[${count}]`, cameras[count]!, channels);
    channels = own.channels;
    count += 1;
    yield copies ? { ...own, data: allocating("a copy of an image", () => own.data.slice()) } : own;
  }
  if (count < cameras.length) throw wrongCount(cameras, `${count} of them`);
}

function wrongCount(cameras: readonly CameraNumbers[], got: string): HprError {
  return new HprError("option", `images must be one image for each of ${cameras.length} cameras, got ${got}`);
}

/** @param channels those of the images before */
function readImage(given: unknown, name: string, camera: CameraNumbers, channels: number | undefined): Image {
  const wrong = (problem: string) => new HprError("option", `${name} ${problem}`);
  if (typeof given !== "object" || given === null) throw wrong(`must be an image, got ${describe(given)}`);
  const [width, height, data] = (["width", "height", "data"] as const).map((part) => ownOf(given, part));
  const [wide, high] = [camera[20]!, camera[21]!];
  if (width !== wide || height !== high) {
    throw wrong(
      `must have the size of its camera's image, ${wide} × ${high}, got ${describe(width)} × ${describe(height)}`,
    );
  }
  const numbers = isNumberArray(data) ? plainNumbers(data) : undefined;
  if (numbers === undefined) {
    throw wrong(`must have a typed array of numbers as data, not transferred away, got ${describe(data)}`);
  }
  const each = ownOf(given, "channels") ?? numbers.length / (wide * high);
  if (!Number.isInteger(each) || (each as number) < 1 || (each as number) * wide * high !== numbers.length) {
    throw wrong(`must have the same number of numbers for each of ${wide * high} pixels, got ${numbers.length}`);
  }
  if (channels !== undefined && each !== channels) {
    throw wrong(`must have ${channels} channels as the first one, got ${describe(each)}`);
  }
  return { data: numbers, channels: each as number };
}
