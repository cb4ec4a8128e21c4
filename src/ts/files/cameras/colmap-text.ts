import { countIn, numberIn } from "../../formats/numbers.js";
import { lineProblem } from "../../formats/problem.js";
import type { Source } from "../../formats/source.js";
import { wordsOf } from "../../formats/text.js";
import { CAMERA_MODELS, type CameraModel, type Intrinsics } from "../../query/camera.js";
import { type CameraOfImage, checked, lensOf, numbersIn, parametersOf, textLines } from "./camera-file.js";
import { cameraBy } from "./colmap.js";

const isContent = (text: string) => text !== "" && !text.startsWith("#");

/** `cameras.txt`: CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS. */
export async function readCameraLines(source: Source): Promise<Map<number, Intrinsics>> {
  const cameras = new Map<number, Intrinsics>();
  for await (const { text, number: line } of textLines(source)) {
    if (!isContent(text)) continue;
    const [id, model, width, height, ...parameters] = wordsOf(text);
    const own = countIn(id);
    if (own === undefined) throw lineProblem(line, "has no number for CAMERA_ID", text);
    if (cameras.has(own)) throw lineProblem(line, "has a CAMERA_ID a second time", text);
    if (!Object.hasOwn(CAMERA_MODELS, model ?? "")) throw lineProblem(line, "has a MODEL that is not read", text);
    const count = parametersOf(model as CameraModel);
    if (parameters.length !== count) {
      throw lineProblem(line, `has ${parameters.length} PARAMS, and ${model!} has ${count}`, text);
    }
    const size = { width: countIn(width) ?? NaN, height: countIn(height) ?? NaN };
    const lens = lensOf(model as CameraModel, size, numbersIn(parameters, line, "PARAMS"));
    cameras.set(own, checked(lens, (says) => lineProblem(line, says, text))); // prettier-ignore
  }
  return cameras;
}

/** `images.txt`: IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME, and below each such line its points in the image. */
export async function readImageLines(
  source: Source,
  cameras: ReadonlyMap<number, Intrinsics>,
): Promise<CameraOfImage[]> {
  const images: CameraOfImage[] = [];
  let isPoints = false;
  for await (const { text, number: line } of textLines(source)) {
    const refuse = (says: string) => lineProblem(line, says, text);
    if (isPoints) {
      // A file without these lines would otherwise lose every other image.
      const words = wordsOf(text);
      const isTriples = words.length % 3 === 0 && (words.length === 0 || numberIn(words.at(-1)!) !== undefined);
      if (!isTriples) throw refuse("does not hold POINTS2D, as every line below an image does");
      isPoints = false;
    } else if (isContent(text)) {
      const [id, qw, qx, qy, qz, tx, ty, tz, camera] = wordsOf(text);
      const name = /^(?:\S+\s+){9}(.+)$/.exec(text)?.[1];
      if (countIn(id) === undefined || name === undefined) throw refuse("is not IMAGE_ID, pose, CAMERA_ID and NAME");
      const pose = numbersIn([qw!, qx!, qy!, qz!, tx!, ty!, tz!], line, "the pose");
      images.push(cameraBy(cameras, countIn(camera), pose, name, refuse));
      isPoints = true;
    }
  }
  return images;
}
