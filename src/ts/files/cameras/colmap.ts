import { FormatProblem, lineProblem } from "../../formats/problem.js";
import { type Source, viewOf, wholeFile } from "../../formats/source.js";
import { CAMERA_MODELS, type CameraModel, type Intrinsics } from "../../query/camera.js";
import { cameraFromPose } from "../../query/cameras.js";
import { type CameraOfImage, checked, lensOf, parametersOf, numbersIn, textLines } from "./camera-file.js";
import { countIn, numberIn } from "../../formats/numbers.js";
import { wordsOf } from "../../formats/text.js";
import { allocating } from "../../base/errors.js";
import { rowsOf } from "../../query/orient-normals.js";
import type { SeenBy } from "../../query/surveys.js";

/** @param pose QW, QX, QY, QZ, TX, TY, TZ: from the world to the camera */
export function cameraBy(
  cameras: ReadonlyMap<number, Intrinsics>,
  id: number | undefined,
  pose: readonly number[],
  image: string,
  refuse: (says: string) => Error,
): CameraOfImage {
  const lens = id === undefined ? undefined : cameras.get(id);
  if (lens === undefined) throw refuse("has a CAMERA_ID that the file of cameras does not have");
  const [w, x, y, z, ...place] = pose as [number, number, number, number, ...number[]];
  const length = Math.hypot(w, x, y, z);
  if (![...pose, length].every(Number.isFinite) || length === 0) {
    throw refuse("has a pose that is not finite, or a quaternion of zeros");
  }
  const { cameraToWorld: worldToCamera } = cameraFromPose(place, [x, y, z, w], lens);
  return { camera: { ...lens, worldToCamera }, image };
}

/** `cameras.bin` */
export async function readCameraBytes(source: Source): Promise<Map<number, Intrinsics>> {
  const bytes = new Bytes(await wholeFile(source));
  const cameras = new Map<number, Intrinsics>();
  const count = bytes.count("the number of cameras", 24);
  for (let i = 0; i < count; i++) {
    const refuse = bytes.refusal(`camera ${i + 1} of ${count}`);
    const [id, number] = [bytes.integer("CAMERA_ID"), bytes.integer("MODEL_ID")];
    if (cameras.has(id)) throw refuse("has a CAMERA_ID a second time");
    const model = Object.keys(CAMERA_MODELS)[number] as CameraModel | undefined;
    if (model === undefined) throw refuse(`has the MODEL_ID ${number}, which is not read`);
    const size = { width: bytes.long("WIDTH"), height: bytes.long("HEIGHT") };
    cameras.set(id, checked(lensOf(model, size, bytes.doubles(parametersOf(model), "PARAMS")), refuse));
  }
  bytes.end();
  return cameras;
}

/** `images.bin` */
export async function readImageBytes(
  source: Source,
  cameras: ReadonlyMap<number, Intrinsics>,
): Promise<CameraOfImage[]> {
  const bytes = new Bytes(await wholeFile(source));
  const images: CameraOfImage[] = [];
  const count = bytes.count("the number of images", 73);
  for (let i = 0; i < count; i++) {
    const refuse = bytes.refusal(`image ${i + 1} of ${count}`);
    bytes.integer("IMAGE_ID");
    const pose = bytes.doubles(7, "the pose");
    const camera = bytes.integer("CAMERA_ID");
    const name = bytes.text("NAME");
    bytes.skip(24 * bytes.count("the number of POINTS2D", 24), "POINTS2D");
    images.push(cameraBy(cameras, camera, pose, name, refuse));
  }
  bytes.end();
  return images;
}

/** Reads little-endian numbers one after another. */
class Bytes {
  readonly #bytes: Uint8Array;
  readonly #view: DataView;
  #at = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
    this.#view = viewOf(bytes);
  }

  integer(field: string): number {
    return this.#view.getUint32(this.skip(4, field), true);
  }

  long(field: string): number {
    return Number(this.#view.getBigUint64(this.skip(8, field), true));
  }

  doubles(count: number, field: string): number[] {
    const from = this.skip(8 * count, field);
    return Array.from({ length: count }, (_, i) => this.#view.getFloat64(from + 8 * i, true));
  }

  /** @param least the bytes that each one takes at least */
  count(field: string, least: number): number {
    const at = this.#at;
    const count = this.long(field);
    if (count * least > this.#bytes.length - this.#at) {
      throw new FormatProblem(`byte ${at} has ${count} for ${field}, more than the file holds`);
    }
    return count;
  }

  /** A text that a zero ends. */
  text(field: string): string {
    const end = this.#bytes.indexOf(0, this.#at);
    if (end < 0) throw new FormatProblem(`byte ${this.#at} begins a text for ${field} that does not end`);
    const text = new TextDecoder().decode(this.#bytes.subarray(this.#at, end));
    this.#at = end + 1;
    return text;
  }

  /** Returns the place of what is skipped. */
  skip(length: number, field: string): number {
    const at = this.#at;
    if (length > this.#bytes.length - at) throw new FormatProblem(`it ends at byte ${this.#bytes.length}, in ${field}`);
    this.#at += length;
    return at;
  }

  refusal(what: string): (says: string) => FormatProblem {
    const at = this.#at;
    return (says) => new FormatProblem(`${what}, at byte ${at}, ${says}`);
  }

  end(): void {
    if (this.#at < this.#bytes.length) throw new FormatProblem(`it goes on at byte ${this.#at}, after its last entry`);
  }
}

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

/**
 * Which cameras see each point, as COLMAP's `fused.ply.vis` says it: little-endian, the number of points in 64 bits, then
 * for each point how many images see it, and their numbers from 0, in 32 bits each.
 *
 * @throws HprError `option` for an argument that is no answer of `seenBy`, `too-large`.
 */
export function colmapVis(seenBy: Pick<SeenBy, "offsets" | "cameras">): Uint8Array<ArrayBuffer> {
  const { offsets, values: cameras } = rowsOf(seenBy, "cameras", 1, Uint32Array);
  const count = offsets.length - 1;
  const file = allocating(`${count} rows`, () => new DataView(new ArrayBuffer(8 + 4 * (count + cameras.length))));
  file.setBigUint64(0, BigInt(count), true);
  let at = 8;
  const put = (number: number) => {
    file.setUint32(at, number, true);
    at += 4;
  };
  for (let i = 0; i < count; i++) {
    const row = cameras.subarray(offsets[i], offsets[i + 1]);
    put(row.length);
    row.forEach(put);
  }
  return new Uint8Array(file.buffer);
}
