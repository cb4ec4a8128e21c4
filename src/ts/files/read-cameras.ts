import { describe, HprError, typeTag } from "../base/errors.js";
import { hasNodeModules, importNodeModule } from "../base/node.js";
import { FormatProblem } from "../formats/problem.js";
import { looksBinary } from "../formats/text.js";
import { givenOptions } from "../query/options.js";
import type { CameraOfImage, ImageSize } from "./cameras/camera-file.js";
import { readCameraBytes, readImageBytes, readCameraLines, readImageLines } from "./cameras/colmap.js";
import { readJson, readKitti, readOpenCv } from "./cameras/calibrations.js";
import { type FileSource, type NamedSource, refusal, sourceOf } from "./source-of.js";

export type { CameraOfImage, FileSource, ImageSize };

/**
 * Reads the cameras of images: COLMAP's `cameras` and `images` (`.bin` or `.txt`), nerfstudio's `transforms.json`, JSON
 * of one camera or a list of them (each with its `image`, if it has one), KITTI's `calib.txt` or its raw pair `calib_cam_to_cam.txt` and `calib_velo_to_cam.txt`, and the YAML of OpenCV and ROS. u = 0 is the left edge of the first pixel, so cx and cy of OpenCV and KITTI
 * get ½ more.
 *
 * @param source a file, as for `readCloud`; a folder (its path, in Node), or a list of files with names (in pages, those of
 *   an input), of which COLMAP's are taken, or `transforms.json`, or `calib.txt`
 * @param options the `width` and `height` of images, for files that do not say them. Default: 1242 and 375 for KITTI
 * @returns the cameras in the order of the file, each with the name of its image. KITTI's are `image_0` to `image_3`;
 *   OpenCV's have none, and no pose
 * @throws HprError (as a rejection) `load` if a file cannot be read; the message names the line or the byte, and the
 *   field. `option` for a wrong source or option
 */
export async function readCameras(
  source: FileSource | ArrayLike<FileSource>,
  options: Partial<ImageSize> = {},
): Promise<CameraOfImage[]> {
  const size = sizeIn(options);
  const files = await filesOf(source);
  const opened: NamedSource[] = [];
  try {
    for (const file of files) opened.push(await sourceOf(file, undefined));
    const [first, second] = opened as [NamedSource, NamedSource?];
    if (second === undefined) return await reading(first, async () => checkPoses(await readOne(first, size)));
    if (/calib_\w+\.txt$/i.test(first.name)) {
      const both = { ...first, name: `${first.name} or ${second.name}` };
      return await reading(both, async () => checkPoses(await readKitti(size, first.source, second.source)));
    }
    const isText = /\.txt$/i.test(first.name);
    const cameras = await reading(first, () => (isText ? readCameraLines : readCameraBytes)(first.source));
    const read = isText ? readImageLines : readImageBytes;
    return await reading(second, async () => checkPoses(await read(second.source, cameras)));
  } finally {
    await Promise.all(opened.map(({ close }) => close()));
  }
}

/** Finite numbers of a file may make a pose that is not. */
function checkPoses(cameras: CameraOfImage[]): CameraOfImage[] {
  return cameras.map(({ camera, image }, i) => {
    const name = camera.worldToCamera === undefined ? "cameraToWorld" : "worldToCamera";
    const pose = Array.from(camera[name]!);
    if (!pose.every(Number.isFinite)) {
      throw new FormatProblem(`the pose of camera ${i + 1}${image === "" ? "" : ` (${image})`} is not finite`);
    }
    return { camera: { ...camera, [name]: withRotation(pose) }, image };
  });
}

/** How far a matrix of a file may be from a rotation: single precision, written as text, is up to 1.5e-4 away. */
const ROUNDED = 1e-3;

/** The pose with the nearest rotation, where its numbers were rounded to fewer digits than cameras take. */
function withRotation(pose: number[]): number[] {
  const most = Math.max(...offOf(pose).flat().map(Math.abs));
  if (most < 2e-6 || !(most <= ROUNDED)) return pose;
  // Björck's iteration for the polar decomposition: each step squares the distance.
  for (let step = 0; step < 3; step++) {
    const off = offOf(pose);
    pose = pose.map((x, i) => {
      const column = off[i >> 2];
      if (column === undefined || i % 4 === 3) return x;
      return x + column.reduce((sum, one, other) => sum + (one * pose[4 * other + (i % 4)]!) / 2, 0);
    });
  }
  return pose;
}

/** By how much the products of the axes differ from those of a rotation. */
function offOf(pose: number[]): number[][] {
  const axes = [0, 4, 8].map((start) => pose.slice(start, start + 3));
  const dot = (a: number[], b: number[]) => a.reduce((sum, x, i) => sum + x * b[i]!, 0);
  return axes.map((a) => axes.map((b) => (a === b ? 1 : 0) - dot(a, b)));
}

async function reading<T>({ name }: NamedSource, read: () => Promise<T>): Promise<T> {
  try {
    return await read();
  } catch (cause) {
    throw refusal(name, cause);
  }
}

/** One file that holds everything. */
async function readOne({ source, name }: NamedSource, size: ImageSize | undefined): Promise<CameraOfImage[]> {
  const bytes = await source.read(0, 1 << 16);
  const start = new TextDecoder().decode(bytes);
  if (/^\s*[[{]/.test(start)) return readJson(source, size);
  if (/^(%YAML|camera_matrix\s*:)/im.test(start)) return readOpenCv(source, size);
  if (/^P[0-3]:?[ \t]/m.test(start)) return readKitti(size, source);
  if (/^(P_rect_0\d|T):[ \t]/m.test(start)) {
    throw new FormatProblem(
      "KITTI's raw calibration is two files: give calib_cam_to_cam.txt and calib_velo_to_cam.txt",
    );
  }
  if (/^# 3D point list/im.test(start) || /points3D\.(txt|bin)$/i.test(name)) {
    throw new FormatProblem("it holds COLMAP's points, not its cameras; readCloud reads points");
  }
  if (looksBinary(bytes) || /(cameras|images)\.(txt|bin)$|^# (Camera|Image) list/im.test(`${name}\n${start}`)) {
    throw new FormatProblem("COLMAP keeps cameras and images in two files; give both, or their folder");
  }
  throw new FormatProblem("it is none of the files of cameras that are read (COLMAP, nerfstudio, KITTI, OpenCV)");
}

/** One file, or COLMAP's two. */
async function filesOf(source: unknown): Promise<unknown[]> {
  const isList = Array.isArray(source) || typeTag(source) === "FileList";
  const folder = isList ? Array.from(source as ArrayLike<unknown>, listed) : await filesIn(source);
  if (folder === undefined) return [source];
  const named = (name: string) => folder.find((file) => nameOf(file) === name);
  for (const names of [
    ["cameras.bin", "images.bin"],
    ["cameras.txt", "images.txt"],
    ["transforms.json"],
    ["calib.txt"],
    ["calib_cam_to_cam.txt", "calib_velo_to_cam.txt"],
  ]) {
    const chosen = names.map(named);
    if (chosen.every((file) => file !== undefined)) return chosen;
  }
  if (folder.length === 1) return folder;
  const what = isList ? "the list of files" : String(source);
  throw new HprError(
    isList ? "option" : "load",
    `${what} must hold cameras and images (.bin or .txt), transforms.json or calib.txt`,
  );
}

function listed(file: unknown): unknown {
  if (typeof file === "string" || (typeof file === "object" && file !== null)) return file;
  throw new HprError("option", `the list of files must hold files, got ${describe(file)}`);
}

/** The files in a folder; undefined if this is no folder. */
async function filesIn(source: unknown): Promise<unknown[] | undefined> {
  const isUrl = source instanceof URL && source.protocol === "file:";
  if (!(isUrl || (typeof source === "string" && hasNodeModules()))) return undefined;
  const { readdir, stat } = await importNodeModule<typeof import("node:fs/promises")>("node:fs/promises");
  const { fileURLToPath } = await importNodeModule<typeof import("node:url")>("node:url");
  try {
    const path = isUrl ? fileURLToPath(source) : source;
    if (!(await stat(path)).isDirectory()) return undefined;
    return (await readdir(path)).map((name) => `${path}/${name}`);
  } catch {
    // It is no file at all, which is said when it is opened.
    return undefined;
  }
}

function nameOf(file: unknown): string {
  const name = typeof file === "string" ? file : file instanceof URL ? file.pathname : (file as File | null)?.name;
  return String(name).split(/[\\/]/).at(-1)!.toLowerCase();
}

function sizeIn(options: unknown): ImageSize | undefined {
  const { width, height } = givenOptions(options, ["width", "height"]);
  if (width === undefined && height === undefined) return undefined;
  for (const [name, value] of Object.entries({ width, height })) {
    if (!(typeof value === "number" && value > 0 && value < Infinity)) {
      throw new HprError("option", `${name} must be a finite and positive number, got ${describe(value)}`);
    }
  }
  return { width: width as number, height: height as number };
}
