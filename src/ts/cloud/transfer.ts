import { describe, HprError } from "../base/errors.js";
import type { Camera } from "../query/camera.js";
import type { TransferImage } from "../query/images.js";
import type { SeenBy } from "../query/seen-by.js";
import { type CoverageOptions, surveyed } from "../query/surveys.js";
import { TRANSFER_ROWS, type TransferOptions } from "../query/option-rows.js";
import { type Transferred, TransferTask } from "../query/transfer.js";
import type { PointCloud } from "./cloud.js";

/** A `WorkerPointCloud`. */
interface InWorkers {
  seenBy(cameras: readonly Camera[], options?: CoverageOptions): Promise<SeenBy>;
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
): Transferred;
/** The same for a `WorkerPointCloud`: its workers share the cameras, and the images stay here. */
export function transfer(
  cloud: InWorkers,
  cameras: readonly Camera[],
  images: readonly TransferImage[],
  options?: TransferOptions & { signal?: AbortSignal | undefined; latest?: boolean | undefined },
): Promise<Transferred>;
export function transfer(
  cloud: PointCloud | InWorkers,
  cameras: readonly Camera[],
  images: readonly TransferImage[],
  options?: TransferOptions,
): Transferred | Promise<Transferred> {
  const ask = surveyed.get(cloud);
  if (ask === undefined) {
    throw new HprError("option", `transfer needs a PointCloud or a WorkerPointCloud, got ${describe(cloud)}`);
  }
  return ask([
    "transfer",
    options,
    TRANSFER_ROWS,
    (dimension, given, progress) => new TransferTask(dimension, cameras, images, given, progress),
  ]);
}
