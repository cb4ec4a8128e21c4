import type { Found, Photographed } from "./answers.js";
import type { CameraNumbers } from "./camera.js";
import { type Image, readImages, type TransferImage, valueAt, valueBetween } from "./images.js";
import { type Merge, merged } from "./merge-values.js";
import type { TRANSFER_ROWS, TransferOptions } from "./option-rows.js";
import { type Checked, requireSpace } from "./options.js";
import { MAX_LENGTH } from "./positions.js";
import { readCameras } from "./seats.js";
import { SurveyTask } from "./surveys.js";
import { refuseScores, viewSettings } from "./view-options.js";
import { HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";

export type { TransferOptions };

/** What images say about the points of a cloud. */
export interface Transferred {
  /** `channels` numbers for each index, in the images' own scale; NaN where `seen` is 0. */
  values: Float32Array<ArrayBuffer>;
  channels: number;
  /** How many cameras gave a value, for each index. */
  seen: Uint32Array<ArrayBuffer>;
  /** What is probably wrong with a camera; see `Visibility.note`. */
  note?: string;
}

/** What one camera sees: the points, where they are in the image, and how much they count. */
interface Entries {
  indices: Uint32Array;
  pixels: Float32Array;
  /** Undefined if all count the same. */
  weights: Float32Array | undefined;
}

/** Takes values from images to points, after the cameras were asked. */
export class TransferTask extends SurveyTask<Transferred> {
  readonly #lenses: readonly CameraNumbers[];
  readonly #images: Image[];
  readonly #channels: number;
  readonly #merge: Merge;
  readonly #weigh: TransferOptions["weights"];
  readonly #read: typeof valueAt;
  readonly #views: Entries[] = [];

  constructor(
    dimension: number,
    cameras: unknown,
    images: readonly TransferImage[],
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
    const own = readImages(images, seats);
    const asked = { ...given, ...(!isChosen && { looks: 3 }), scores: weigh === "score" };
    super({ seats, settings: viewSettings(asked, dimension), towards: false }, progress);
    this.#lenses = seats;
    [this.#images, this.#channels] = [own.images, own.channels];
    this.#merge = merge;
    this.#weigh = weigh;
    this.#read = sampling === "nearest" ? valueAt : valueBetween;
  }

  protected override add(number: number, found: Found): void {
    const { indices, pixels, depths, scores } = found as Photographed;
    const lens = this.#lenses[number]!;
    const weights =
      this.#weigh &&
      depths.map((depth, k) => {
        if (this.#weigh === "distance") return 1 / (depth * depth);
        if (this.#weigh === "score") return scores![indices[k]!]!;
        const [x, y] = [(pixels[2 * k]! - lens[18]!) / lens[16]!, (pixels[2 * k + 1]! - lens[19]!) / lens[17]!];
        return 1 / Math.hypot(1, x, y);
      });
    this.#views[number] = { indices, pixels, weights };
  }

  protected override more(): number[] {
    return [];
  }

  /** @param length the length of the cloud */
  result(length: number): Transferred {
    const [channels, views] = [this.#channels, this.#views];
    if (length * channels > MAX_LENGTH) {
      throw new HprError("too-large", `${length * channels} values exceed the limit of ${MAX_LENGTH}`);
    }
    const [values, seen] = allocating(`${length} values of ${channels} channels`, () => [
      new Float32Array(length * channels).fill(NaN),
      new Uint32Array(length),
    ]);
    const next = views.map(() => 0);
    const rows = views.map(() => new Float64Array(channels));
    const weights = new Float64Array(views.length);
    const target = new Float64Array(channels);
    for (let index = 0; index < length; index++) {
      let count = 0;
      for (const [number, view] of views.entries()) {
        const k = next[number]!;
        if (view.indices[k] !== index) continue;
        next[number] = k + 1;
        const [u, v] = [view.pixels[2 * k]!, view.pixels[2 * k + 1]!];
        if (!this.#read(this.#images[number]!, channels, u, v, rows[count]!)) continue;
        weights[count] = view.weights?.[k] ?? 1;
        count += 1;
      }
      seen[index] = count;
      if (count > 0) {
        merged(this.#merge, rows, weights, count, target);
        values.set(target, index * channels);
      }
    }
    return { values, channels, seen, ...this.noted };
  }
}
