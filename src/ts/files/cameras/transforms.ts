import { describe, HprError } from "../../base/errors.js";
import { FormatProblem } from "../../formats/problem.js";
import { type Source, wholeFile } from "../../formats/source.js";
import { type ImageCamera, isCamera, readCamera } from "../../query/camera.js";
import { type CameraOfImage, checked, type ImageSize } from "./camera-file.js";

type Fields = Record<string, unknown>;

/** The names of lenses without a bend, whose distortion nerfstudio takes from k1 to p2 all the same. */
const PLAIN = ["SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV"];
const FISHEYE = ["OPENCV_FISHEYE", "RADIAL_FISHEYE", "SIMPLE_RADIAL_FISHEYE"];

/** A JSON file: nerfstudio's `transforms.json`, or cameras of this package. */
export async function readJson(source: Source, size: ImageSize | undefined): Promise<CameraOfImage[]> {
  const bytes = await wholeFile(source);
  let json: unknown;
  try {
    json = JSON.parse(new TextDecoder().decode(bytes));
  } catch (cause) {
    throw new FormatProblem(`it is not JSON: ${(cause as Error).message}`, { cause });
  }
  if (Array.isArray(json) || isCamera(json)) return [json].flat().map(ownCamera);
  // A frame's own numbers go before those of the file.
  const frames = isFields(json) ? json["frames"] : undefined;
  if (!Array.isArray(frames)) throw new FormatProblem(`frames must be an array, got ${describe(frames)}`);
  return frames.map((frame: unknown, i) => cameraOf(json as Fields, frame, `frames[${i}]`, size));
}

/** A camera as the methods take it, with the name of its image if it has one. */
function ownCamera(given: unknown, i: number): CameraOfImage {
  const { image = "", ...camera } = isFields(given) ? given : { given };
  if (typeof image !== "string") throw new FormatProblem(`cameras[${i}].image must be a text, got ${describe(image)}`);
  try {
    readCamera(isFields(given) ? camera : given, `camera [${i}]`);
  } catch (cause) {
    throw cause instanceof HprError ? new FormatProblem(cause.message, { cause }) : cause;
  }
  return { camera: camera as unknown as ImageCamera, image };
}

function cameraOf(file: Fields, frame: unknown, where: string, size: ImageSize | undefined): CameraOfImage {
  const wrong = (field: string, must: string, got: unknown) =>
    new FormatProblem(`${where}.${field} must be ${must}, got ${describe(got)}`);
  if (!isFields(frame)) throw new FormatProblem(`${where} must be an object, got ${describe(frame)}`);
  const field = (name: string) => frame[name] ?? file[name];
  const optional = (name: string) => {
    const value = field(name);
    if (value === undefined || value === null) return undefined;
    if (typeof value !== "number" || !Number.isFinite(value)) throw wrong(name, "a finite number", value);
    return value;
  };
  const number = (name: string, usual: number | undefined) => {
    const value = optional(name) ?? usual;
    if (value === undefined) throw wrong(name, "a finite number", undefined);
    return value;
  };
  const focal = (name: string, angle: string, length: number) => {
    const opening = optional(angle);
    return optional(name) ?? (opening === undefined ? undefined : length / 2 / Math.tan(opening / 2));
  };
  const [width, height] = [number("w", size?.width), number("h", size?.height)];
  const [fx, fy] = [focal("fl_x", "camera_angle_x", width), focal("fl_y", "camera_angle_y", height)];
  if (fx === undefined) throw wrong("fl_x", "a finite number", undefined);
  const name = field("camera_model") ?? "OPENCV";
  const isFisheye = FISHEYE.includes(name as string) || field("is_fisheye") === true;
  if (!isFisheye && !PLAIN.includes(name as string)) {
    throw wrong("camera_model", `one of ${[...PLAIN, ...FISHEYE].join(", ")}`, name);
  }
  const [k1, k2, k3, k4, p1, p2] = ["k1", "k2", "k3", "k4", "p1", "p2"].map((name) => number(name, 0)) as [
    number, number, number, number, number, number,
  ]; // prettier-ignore
  if (!isFisheye && k4 !== 0) throw wrong("k4", "0 for a lens that is no fisheye", k4);
  const image = frame["file_path"];
  if (typeof image !== "string") throw wrong("file_path", "a text", image);
  const lens = {
    ...{ fx, fy: fy ?? fx, cx: number("cx", width / 2), cy: number("cy", height / 2), width, height },
    ...(isFisheye
      ? { model: "OPENCV_FISHEYE" as const, distortion: [k1, k2, k3, k4] }
      : { model: "OPENCV" as const, distortion: [k1, k2, p1, p2, k3] }),
  };
  checked(lens, (says) => new FormatProblem(`${where} ${says}`));
  const rows = frame["transform_matrix"];
  if (!isMatrix(rows)) throw wrong("transform_matrix", "4 rows of 4 finite numbers", rows);
  const cameraToWorld = Array.from({ length: 16 }, (_, i) => rows[i % 4]![i >> 2]!);
  return { camera: { ...lens, cameraToWorld, convention: "opengl" }, image };
}

function isFields(value: unknown): value is Fields {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function isMatrix(rows: unknown): rows is number[][] {
  const isRow = (row: unknown) => Array.isArray(row) && row.length === 4 && row.every((x) => Number.isFinite(x));
  return Array.isArray(rows) && rows.length === 4 && rows.every(isRow);
}
