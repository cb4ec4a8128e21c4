// From where: files of cameras or of viewpoints, and whether these are near the cloud.
import { Contradictions, lineProblem, printable } from "../formats/problem.js";
import { stat } from "node:fs/promises";
import { parse } from "node:path";

import { TableRows } from "../formats/table.js";
import { cell, isComment, separatorOf, split } from "../formats/table-words.js";
import { bytesSource, lines as linesOf } from "../formats/source.js";
import { trimmed } from "../formats/text.js";
import { type ImageSize, readCameras } from "../files/read-cameras.js";
import { type ImageCamera, isCamera } from "../query/camera.js";
import { InputProblem } from "./files.js";

/** A viewpoint, or a camera in its place. */
export interface NamedSeat {
  name: string;
  seat: number[] | ImageCamera;
}

/** A camera, and the image that it has taken. */
export interface NamedCamera extends NamedSeat {
  seat: ImageCamera;
  image: string;
}

/** Whether a name is that of a file, or a folder, of cameras, and not of a table. */
export async function holdsCameras(name: string): Promise<boolean> {
  return /\.(json|ya?ml|bin)$/i.test(name) || ((await stat(name).catch(() => undefined))?.isDirectory() ?? false);
}

/**
 * The cameras of a file or a folder, as `readCameras` reads them. They are checked before the points are read. A camera is
 * called as its image is, without the folder and the ending, or by its number, from 1.
 *
 * @param inFileNames whether the names become parts of names of files
 * @param size that of the images, if the file does not say it
 */
export async function camerasIn(file: string, inFileNames: boolean, size?: ImageSize): Promise<NamedCamera[]> {
  const cameras = await readCameras(file, size);
  if (cameras.length === 0) throw new InputProblem(`${file} cannot be read: it has no cameras`);
  const known = new Set<string>();
  return cameras.map(({ camera, image }, i) => {
    const refusal = (says: string) => new InputProblem(`${file} cannot be read: camera ${i + 1} (${image}) ${says}`);
    const name = parse(image.replaceAll("\\", "/")).name || String(i + 1);
    if (inFileNames) takeName(name, known, refusal);
    return { name, seat: camera, image };
  });
}

/**
 * The viewpoints of a table with the columns x,y,z or name,x,y,z, with or without a line of names.
 * Viewpoints without a name are called by their number, from 1.
 *
 * @param inFileNames whether the names become parts of names of files
 */
export async function viewpointsIn(file: Buffer<ArrayBuffer>, inFileNames: boolean): Promise<NamedSeat[]> {
  const lines: { text: string; number: number }[] = [];
  for await (const { texts, number } of linesOf(bytesSource(file), 0)) {
    for (const [i, text] of texts.entries()) lines.push({ text, number: number + i });
  }
  const bareName = hasBareName(lines.map(({ text }) => trimmed(text)).find((text) => text !== "" && !isComment(text)));
  const rows = new TableRows(bareName ? ["2", "3", "4"] : undefined);
  const found: NamedSeat[] = [];
  const known = new Set<string>();
  for (const { text, number } of lines) {
    const point = rows.take(text, number);
    if (point === undefined) continue;
    const { names, width } = rows.layout!;
    if (names === undefined && !bareName && width > 3) {
      throw lineProblem(number, `has ${width} columns without names; begin with a line such as name,x,y,z`);
    }
    const column = bareName ? 0 : (names?.bare.indexOf("name") ?? -1);
    const name = column < 0 ? String(found.length + 1) : point.words[column]!;
    if (!point.position.every(Number.isFinite)) throw lineProblem(number, "has a coordinate that is not finite", text);
    if (inFileNames) takeName(name, known, (says) => lineProblem(number, says, text));
    found.push({ name, seat: [...point.position] });
  }
  rows.finish(new Contradictions(false));
  return found;
}

/** Refuses a name that cannot become part of the name of a file, or would do so twice. */
function takeName(name: string, known: Set<string>, refusal: (says: string) => Error): void {
  if (!isFileName(name)) throw refusal("has a name that no file can have");
  // Some file systems do not tell capitals from small letters.
  const same = name.normalize("NFC").toLowerCase();
  if (known.has(same)) throw refusal("has a name a second time");
  known.add(same);
}

/** Whether a name can stand in the name of a file on every system, and leads to no other folder. */
function isFileName(name: string): boolean {
  return name === printable(name) && !/^\.{0,2}$|[/\\<>:"|?*]/.test(name);
}

/** Whether a line is a name and three numbers. A name that is a number itself needs a line of names above. */
function hasBareName(line: string | undefined): boolean {
  const words = line === undefined ? [] : (split(line, separatorOf(line)) ?? []);
  const [name = "", ...numbers] = words;
  const isNumber = (word: string) => word !== "" && cell(word) !== undefined;
  return words.length === 4 && cell(name) === undefined && numbers.every(isNumber);
}

/** How many extents of the cloud a viewpoint may be from it. The cloud then fills half a degree of the view. */
const FAR = 100;

/**
 * Notes viewpoints that are so far from the cloud that their coordinates are probably of another system. Undefined if all
 * are near enough.
 */
export function farNote(positions: Float32Array | Float64Array, seats: readonly NamedSeat[]): string | undefined {
  const box = boxOf(positions);
  const extent = Math.hypot(...box.map(([low, high]) => high - low));
  const viewpoints = viewpointsOf(seats);
  const far = viewpoints
    .map(({ name, viewpoint }) => ({ name, distance: distanceTo(box, viewpoint) }))
    .filter(({ distance }) => extent > 0 && distance > FAR * extent);
  const [first] = far;
  if (first === undefined) return undefined;
  const others = far.length > 1 ? ` (of ${viewpoints.length} viewpoints, ${far.length} are as far)` : "";
  return `note: ${first.name} is ${said(first.distance)} units from the cloud, whose extent is ${said(extent)}${others}`;
}

function viewpointsOf(seats: readonly NamedSeat[]): { name: string; viewpoint: readonly number[] }[] {
  return seats.map(({ name, seat }) =>
    isCamera(seat)
      ? { name: `the camera ${name}`, viewpoint: placeOf(seat as ImageCamera) }
      : { name: `the viewpoint${name === "" ? "" : ` ${name}`}`, viewpoint: seat as number[] },
  );
}

/** The place of a camera whose pose was read, except for the rounding of its numbers. */
function placeOf({ cameraToWorld, worldToCamera: m }: ImageCamera): number[] {
  if (m === undefined) return Array.from(cameraToWorld).slice(12, 15);
  return [0, 4, 8].map((i) => -(m[i]! * m[12]! + m[i + 1]! * m[13]! + m[i + 2]! * m[14]!));
}

type Range = [low: number, high: number];

/** The least and the largest x, y and z. Numbers that are not finite do not count. */
function boxOf(positions: Float32Array | Float64Array): Range[] {
  const box = [0, 1, 2].map((): Range => [Infinity, -Infinity]);
  for (let i = 0; i < positions.length; i++) {
    const value = positions[i]!;
    const range = box[i % 3]!;
    if (!Number.isFinite(value)) continue;
    if (value < range[0]) range[0] = value;
    if (value > range[1]) range[1] = value;
  }
  return box;
}

function distanceTo(box: readonly Range[], viewpoint: readonly number[]): number {
  return Math.hypot(...box.map(([low, high], axis) => Math.max(low - viewpoint[axis]!, 0, viewpoint[axis]! - high)));
}

/** Two digits are enough, with commas between the thousands. */
function said(length: number): string {
  return length.toLocaleString("en", { maximumSignificantDigits: 2 });
}
