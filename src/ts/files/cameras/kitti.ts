import { FormatProblem, lineProblem } from "../../formats/problem.js";
import type { Source } from "../../formats/source.js";
import { wordsOf } from "../../formats/text.js";
import { type CameraOfImage, checked, type ImageSize, numbersIn, textLines } from "./camera-file.js";

/** The size of most of KITTI's rectified images. Its files do not say it. */
const USUAL_SIZE: ImageSize = { width: 1242, height: 375 };

/** The matrices that are read, and how many numbers they have. `Tr` is the odometry's name of `Tr_velo_to_cam`. */
const MATRICES: Readonly<Record<string, number>> = {
  P0: 12, P1: 12, P2: 12, P3: 12, R0_rect: 9, R_rect: 9, Tr_velo_to_cam: 12, Tr_velo_cam: 12, Tr: 12,
}; // prettier-ignore

/** The rows of a rotation and a translation. */
type Rigid = readonly (readonly [number, number, number, number])[];

/** KITTI's calibration. The cloud is in the coordinates of the lidar; without `Tr_velo_to_cam`, in those of camera 0. */
export async function readKitti(source: Source, size: ImageSize = USUAL_SIZE): Promise<CameraOfImage[]> {
  const found = new Map<string, { numbers: number[]; line: number }>();
  for await (const { text, number: line } of textLines(source)) {
    const [, name = "", rest = ""] = /^(\w+):?[ \t]+(.*)$/.exec(text) ?? [];
    const count = Object.hasOwn(MATRICES, name) ? MATRICES[name]! : undefined;
    if (count === undefined) continue;
    const numbers = numbersIn(wordsOf(rest), line, name);
    if (numbers.length !== count) {
      throw lineProblem(line, `has ${numbers.length} numbers for ${name}, which has ${count}`);
    }
    if (found.has(name)) throw lineProblem(line, `has ${name} a second time`);
    found.set(name, { numbers, line });
  }
  const named = (...names: string[]) => names.map((name) => found.get(name)).find(Boolean)?.numbers;
  const r = named("R0_rect", "R_rect") ?? [1, 0, 0, 0, 1, 0, 0, 0, 1];
  const t = named("Tr_velo_to_cam", "Tr_velo_cam", "Tr") ?? [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
  const rectified = product([0, 3, 6].map((i) => [r[i]!, r[i + 1]!, r[i + 2]!, 0]), [0, 4, 8].map((i) => [t[i]!, t[i + 1]!, t[i + 2]!, t[i + 3]!])); // prettier-ignore
  const cameras: CameraOfImage[] = [];
  for (const number of [0, 1, 2, 3]) {
    const matrix = found.get(`P${number}`);
    if (matrix === undefined) continue;
    const [fx, skew, u, x, a, fy, v, y, b, c, d, z] = matrix.numbers as [number, ...number[]] & Record<number, number>;
    if (skew !== 0 || a !== 0 || b !== 0 || c !== 0 || d !== 1) {
      throw lineProblem(
        matrix.line,
        `has a P${number} with a skew, or a third row that is not 0 0 1, which is not read`,
      );
    }
    // The first pixel's center is at 0 there.
    const lens = checked({ fx, fy: fy!, cx: u! + 0.5, cy: v! + 0.5, ...size }, (says) =>
      lineProblem(matrix.line, says),
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
