import type { Camera } from "../query/camera.js";
import type { TransferImage } from "../query/images.js";
import { SURVEY, type SurveyQuestion } from "../query/surveys.js";
import { TRANSFER_OPTIONS, type Transferred, type TransferOptions, TransferTask } from "../query/transfer.js";

/** A `PointCloud`. */
interface Here {
  [SURVEY]: <Result>(...question: SurveyQuestion<Result>) => Result;
}

/** A `WorkerPointCloud`. */
interface InWorkers {
  [SURVEY]: <Result>(...question: SurveyQuestion<Result>) => Promise<Result>;
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
  cloud: Here,
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
  cloud: Here | InWorkers,
  cameras: readonly Camera[],
  images: readonly TransferImage[],
  options?: TransferOptions,
): Transferred | Promise<Transferred> {
  return cloud[SURVEY]("transfer", options, TRANSFER_OPTIONS, (dimension, given, progress) => {
    return new TransferTask(dimension, cameras, images, given, progress);
  });
}
