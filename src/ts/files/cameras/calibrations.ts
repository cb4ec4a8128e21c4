import { FormatProblem, lineProblem } from "../../formats/problem.js";
import { type Source, wholeFile } from "../../formats/source.js";
import { trimmed, wordsOf } from "../../formats/text.js";
import { type CameraOfImage, checked, type ImageSize, numbersIn, textLines } from "./camera-file.js";
import { type ImageCamera, type Intrinsics, isCamera, readCamera } from "../../query/camera.js";
import { describe, HprError } from "../../base/errors.js";

/** The size of most of KITTI's rectified images. Its files do not say it. */
const USUAL_SIZE: ImageSize = { width: 1242, height: 375 };

/**
 * The matrices that are read, and how many numbers they have. `Tr` is the odometry's name of `Tr_velo_to_cam`, which are `R`
 * and `T` of the raw data; `S_rect` are sizes.
 */
const MATRICES: readonly (readonly [name: RegExp, count: number])[] = [
  [/^(P(_rect_0)?[0-3]|Tr(_velo(_to)?_cam)?)$/, 12],
  [/^(R|R0?_rect|R_rect_00)$/, 9],
  [/^T$/, 3],
  [/^S_rect_0\d$/, 2],
];

/** The rows of a rotation and a translation. */
type Rigid = readonly (readonly [number, number, number, number])[];

/** KITTI's calibration. The cloud is in the coordinates of the lidar; without `Tr_velo_to_cam`, in those of camera 0. */
export async function readKitti(size: ImageSize | undefined, ...sources: Source[]): Promise<CameraOfImage[]> {
  const found = new Map<string, { numbers: number[]; line: number }>();
  for (const source of sources) {
    for await (const { text, number: line } of textLines(source)) {
      const [, name = "", rest = ""] = /^(\w+):?[ \t]+(.*)$/.exec(text) ?? [];
      const [, count] = MATRICES.find(([known]) => known.test(name)) ?? [];
      if (count === undefined) continue;
      const numbers = numbersIn(wordsOf(rest), line, name);
      if (numbers.length !== count) {
        throw lineProblem(line, `has ${numbers.length} numbers for ${name}, which has ${count}`);
      }
      if (found.has(name)) throw lineProblem(line, `has ${name} a second time`);
      found.set(name, { numbers, line });
    }
  }
  const named = (...names: string[]) => names.map((name) => found.get(name)).find(Boolean)?.numbers;
  const r = named("R0_rect", "R_rect", "R_rect_00") ?? [1, 0, 0, 0, 1, 0, 0, 0, 1];
  const [turn, move] = [named("R"), named("T")];
  const raw = turn && move?.flatMap((by, i) => [...turn.slice(3 * i, 3 * i + 3), by]);
  const t = named("Tr_velo_to_cam", "Tr_velo_cam", "Tr") ?? raw ?? [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
  const rectified = product([0, 3, 6].map((i) => [r[i]!, r[i + 1]!, r[i + 2]!, 0]), [0, 4, 8].map((i) => [t[i]!, t[i + 1]!, t[i + 2]!, t[i + 3]!])); // prettier-ignore
  const cameras: CameraOfImage[] = [];
  for (const number of [0, 1, 2, 3]) {
    const matrix = found.get(`P${number}`) ?? found.get(`P_rect_0${number}`);
    const [width, height] = named(`S_rect_0${number}`) ?? [USUAL_SIZE.width, USUAL_SIZE.height];
    if (matrix === undefined) continue;
    const [fx, skew, u, x, a, fy, v, y, b, c, d, z] = matrix.numbers as [number, ...number[]] & Record<number, number>;
    if (skew !== 0 || a !== 0 || b !== 0 || c !== 0 || d !== 1) {
      throw lineProblem(
        matrix.line,
        `has a P${number} with a skew, or a third row that is not 0 0 1, which is not read`,
      );
    }
    // The first pixel's center is at 0 there.
    const lens = checked(
      { fx, fy: fy!, cx: u! + 0.5, cy: v! + 0.5, ...(size ?? { width: width!, height: height! }) },
      (says) => lineProblem(matrix.line, says),
    );
    const moved: Rigid = [
      [1, 0, 0, (x! - u! * z!) / fx],
      [0, 1, 0, (y! - v! * z!) / fy!],
      [0, 0, 1, z!],
    ];
    const rows = [...product(moved, rectified), [0, 0, 0, 1]];
    const worldToCamera = Array.from({ length: 16 }, (_, i) => rows[i % 4]![i >> 2]!);
    cameras.push({ camera: { ...lens, worldToCamera }, image: `image_${number}` });
  }
  if (cameras.length === 0) throw new FormatProblem("it has none of P0 to P3");
  return cameras;
}

function product(a: Rigid, b: Rigid): Rigid {
  return a.map(([x, y, z, moved]) => {
    const column = (j: number) => x * b[0]![j]! + y * b[1]![j]! + z * b[2]![j]!;
    return [column(0), column(1), column(2), column(3) + moved];
  });
}

/** A field of the file, with its nested lines. */
interface Field {
  text: string;
  line: number;
}

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A calibration that OpenCV or ROS has written as YAML. It has no pose: the camera is at the origin. */
export async function readOpenCv(source: Source, size: ImageSize | undefined): Promise<CameraOfImage[]> {
  const fields = await fieldsOf(source);
  const matrix = numbersOf(fields, "camera_matrix", [9]);
  if (matrix === undefined) throw new FormatProblem("it has no camera_matrix");
  const [fx, skew, cx, left, fy, cy, ...third] = matrix.numbers as [number, number, number, number, number, number];
  const refuse = (says: string) => lineProblem(matrix.line, says);
  if (skew !== 0 || left !== 0) throw refuse(`has ${skew || left} for the skew of camera_matrix, which must be 0`);
  if (third.join() !== "0,0,1") {
    throw refuse(`has ${third.join(" ")} for the third row of camera_matrix, which must be 0 0 1`);
  }
  const one = (name: string) => numbersOf(fields, name, [1])?.numbers[0];
  const [width, height] = [one("image_width") ?? size?.width, one("image_height") ?? size?.height];
  if (width === undefined || height === undefined) {
    throw new FormatProblem("it has no image_width and image_height; give width and height (--size WxH)");
  }
  // The first pixel's center is at 0 there.
  const lens = checked({ fx, fy, cx: cx + 0.5, cy: cy + 0.5, width, height, ...distortionOf(fields) }, refuse);
  return [{ camera: { ...lens, worldToCamera: IDENTITY }, image: "" }];
}

function distortionOf(fields: ReadonlyMap<string, Field>): Pick<Intrinsics, "model" | "distortion"> {
  const model = fields.get("distortion_model");
  const isFisheye =
    /equidistant|fisheye/.test(model?.text ?? "") || numbersOf(fields, "fisheye_model", [1])?.numbers[0] === 1;
  if (!isFisheye && model !== undefined && !/plumb_bob|rational_polynomial/.test(model.text)) {
    throw lineProblem(model.line, "has a distortion_model that is not read", model.text);
  }
  const found = numbersOf(fields, "distortion_coefficients", isFisheye ? [4] : [0, 4, 5, 8, 12, 14]);
  if (found === undefined) return {};
  if (isFisheye) return { model: "OPENCV_FISHEYE", distortion: found.numbers };
  if (found.numbers.slice(8).some((k) => k !== 0)) {
    throw lineProblem(found.line, "has distortion_coefficients of a thin prism or a tilted sensor, which are not read");
  }
  const distortion = found.numbers.slice(0, 8);
  if (distortion.length === 0) return {};
  return { model: distortion.length > 5 ? "FULL_OPENCV" : "OPENCV", distortion };
}

/** The fields at the left border, by their names in small letters. */
async function fieldsOf(source: Source): Promise<Map<string, Field>> {
  const fields = new Map<string, Field>();
  let last: Field | undefined;
  for await (const { text: line, raw, number } of textLines(source)) {
    const [, name, text = ""] = /^([A-Za-z_]\w*)\s*:(.*)$/.exec(raw) ?? [];
    if (name === undefined) {
      if (last !== undefined && !line.startsWith("#")) last.text += ` ${line}`;
      continue;
    }
    last = { text: trimmed(text), line: number };
    if (fields.has(name.toLowerCase())) throw lineProblem(number, `has ${name} a second time`);
    fields.set(name.toLowerCase(), last);
  }
  return fields;
}

/** The numbers of a field: alone, as a list, or as the data of a matrix. */
function numbersOf(
  fields: ReadonlyMap<string, Field>,
  name: string,
  counts: readonly number[],
): { numbers: number[]; line: number } | undefined {
  const field = fields.get(name);
  if (field === undefined) return undefined;
  const { text, line } = field;
  const list = /\[([^\]]*)\]/.exec(text)?.[1];
  if (list === undefined && (text.includes("[") || counts[0] !== 1)) throw lineProblem(line, `has no list for ${name}`);
  const words = trimmed(list ?? text).split(/[\s,]+/).filter((word) => word !== ""); // prettier-ignore
  const numbers = numbersIn(words, line, name);
  const size = ["rows", "cols"].map((key) => Number(new RegExp(`\\b${key}: *(\\d+)`).exec(text)?.[1] ?? NaN));
  const promised = size[0]! * size[1]!;
  if (!counts.includes(numbers.length) || (!Number.isNaN(promised) && promised !== numbers.length)) {
    throw lineProblem(line, `has ${numbers.length} numbers for ${name}`);
  }
  return { numbers, line };
}

type Fields = Record<string, unknown>;

/** The names of lenses without a bend, whose distortion nerfstudio takes from k1 to p2 all the same. */
const PLAIN = ["SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV"];
const FISHEYE = ["OPENCV_FISHEYE", "RADIAL_FISHEYE", "SIMPLE_RADIAL_FISHEYE"];

/** A JSON file: nerfstudio's `transforms.json`, the `cameras.json` of Gaussian splats, or cameras of this package. */
export async function readJson(source: Source, size: ImageSize | undefined): Promise<CameraOfImage[]> {
  const bytes = await wholeFile(source);
  let json: unknown;
  try {
    json = JSON.parse(new TextDecoder().decode(bytes));
  } catch (cause) {
    throw new FormatProblem(`it is not JSON: ${(cause as Error).message}`, { cause });
  }
  if (Array.isArray(json) || isCamera(json)) return [json].flat().map((given, i) => ownCamera(ofSplats(given), i));
  // A frame's own numbers go before those of the file.
  const frames = isFields(json) ? json["frames"] : undefined;
  if (!Array.isArray(frames)) throw new FormatProblem(`frames must be an array, got ${describe(frames)}`);
  return frames.map((frame: unknown, i) => cameraOf(json as Fields, frame, `frames[${i}]`, size));
}

/** An entry of the `cameras.json` of Gaussian splats, as a camera of this package. */
function ofSplats(given: unknown): unknown {
  if (!isFields(given) || !("img_name" in given)) return given;
  const { img_name: image, width, height, fx, fy } = given;
  const [rotation, position] = [given["rotation"], given["position"]] as [number[][] | undefined, number[] | undefined];
  const axes = [0, 1, 2].map((axis) => [...[0, 1, 2].map((row) => rotation?.[row]?.[axis]), 0]);
  const cameraToWorld = [...axes.flat(), ...[0, 1, 2].map((row) => position?.[row]), 1];
  return { image, fx, fy, cx: Number(width) / 2, cy: Number(height) / 2, width, height, cameraToWorld };
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
    if (value !== undefined) return value;
    throw wrong(name, /^[wh]$/.test(name) ? "given, or width and height (--size WxH)" : "a finite number", undefined);
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
