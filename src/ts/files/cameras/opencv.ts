import { FormatProblem, lineProblem } from "../../formats/problem.js";
import type { Source } from "../../formats/source.js";
import { trimmed } from "../../formats/text.js";
import type { Intrinsics } from "../../query/camera.js";
import { type CameraOfImage, checked, type ImageSize, numbersIn, textLines } from "./camera-file.js";

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
    throw new FormatProblem("it has no image_width and image_height; give width and height");
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
