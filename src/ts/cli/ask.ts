import { transfer, type TransferImage, type TransferOptions, type Transferred } from "../cloud/transfer.js";
import { type ImageCamera, isCamera } from "../query/camera.js";
import type { SeenBy } from "../query/surveys.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { WorkerPointCloud } from "../worker.js";
import { defaultWorkers } from "../worker/team.js";
import type { PointFile } from "./formats.js";
import type { NamedCamera, NamedSeat } from "./places.js";
import { stat } from "node:fs/promises";
import { basename, isAbsolute, join, relative, sep } from "node:path";
import { InputProblem } from "./files.js";

/** What is asked of the cloud. */
export type Question = { options: VisibilityOptions; threshold: number | undefined } & (
  | { kind: "view"; seats: [NamedSeat] }
  | { kind: "each" | "any" | "coverage"; seats: NamedSeat[] }
  | { kind: "rows"; seats: NamedCamera[] }
  | ({ kind: "colors"; seats: NamedCamera[]; images: string } & Pick<TransferOptions, "merge" | "weights">)
);

export interface Answer {
  /** The name of the viewpoint, if each has an answer of its own. */
  name?: string;
  indices: Uint32Array;
  /** The number of all points. */
  length: number;
  /** The number of points without a position. */
  skipped: number;
  scores?: Float32Array;
  /** How many viewpoints see each point. Then `indices` are the points that at least one sees. */
  counts?: Uint32Array;
  /** Which cameras see each point. */
  rows?: SeenBy;
  /** What images say of each point. Then `indices` are the points that at least one camera sees. */
  colors?: Transferred;
  /** What is probably wrong with the camera. */
  note?: string | undefined;
  image?: { pixels: Float32Array; depths: Float32Array };
}

/** Reports the share of the work that is done. */
type OnProgress = (share: number, doing: string) => void;

/**
 * Asks the cloud of a file, one answer after another. The cloud is in workers, so this thread can draw the
 * progress, and several cores share many viewpoints.
 */
export async function* ask(
  { positions }: PointFile,
  question: Question,
  workers: number | undefined,
  onProgress: OnProgress,
): AsyncGenerator<Answer> {
  const cloud = await WorkerPointCloud.create(positions, {
    nonFinite: "skip",
    // The output needs the positions again.
    transfer: question.kind !== "colors",
    workers: workers ?? (sharesViewpoints(question) ? await defaultWorkers(positions.length / 3) : 1),
    onProgress: (share) => {
      onProgress(share / 2, "preparing");
    },
  });
  try {
    const { length, skipped } = cloud;
    onProgress(0.5, "looking");
    for await (const answer of answers(cloud, question, onProgress)) yield { ...answer, length, skipped };
  } finally {
    await cloud.dispose();
  }
}

/** Workers share the viewpoints of one question. */
function sharesViewpoints({ kind }: Question): boolean {
  return kind !== "view" && kind !== "each";
}

async function* answers(
  cloud: WorkerPointCloud,
  question: Question,
  onProgress: OnProgress,
): AsyncGenerator<Omit<Answer, "length" | "skipped">> {
  const { options, threshold } = question;
  const from = async (seat: number[] | ImageCamera) => {
    if (isCamera(seat)) {
      const { indices, pixels, depths, note } = await cloud.visibleFromCamera(seat as ImageCamera, options);
      return { indices, image: { pixels, depths }, note };
    }
    const { indices, scores } = await cloud.visibleFrom(seat as number[], options);
    if (scores === undefined) return { indices };
    return { indices: threshold === undefined ? indices : atLeast(scores, threshold), scores };
  };
  const listening = {
    ...options,
    onProgress: (share: number) => {
      onProgress(0.5 + share / 2, "looking");
    },
  };
  switch (question.kind) {
    case "view":
      yield await from(question.seats[0].seat);
      return;
    case "each":
      for (const [i, { name, seat }] of question.seats.entries()) {
        onProgress(0.5 + i / question.seats.length / 2, "looking");
        yield { name, ...(await from(seat)) };
      }
      return;
    case "any":
    case "coverage": {
      const seats = question.seats.map(({ seat }) => seat);
      const counts = await cloud.coverage(seats, listening);
      yield { indices: atLeast(counts, 1), counts };
      return;
    }
    case "rows": {
      const seats = question.seats.map(({ seat }) => seat);
      const rows = await cloud.seenBy(seats, listening);
      const counts = rows.offsets.subarray(1).map((end, i) => end - rows.offsets[i]!);
      yield { indices: atLeast(counts, 1), rows, note: rows.note };
      return;
    }
    case "colors": {
      const { seats, merge, weights } = question;
      const images = await Promise.all(seats.map(({ image }) => readImage(question.images, image)));
      const cameras = seats.map(({ seat }) => seat);
      const colors = await transfer(cloud, cameras, images, { ...listening, merge, weights });
      yield { indices: atLeast(colors.seen, 1), colors, note: colors.note };
    }
  }
}

/** The places of the numbers that reach a threshold. */
function atLeast(numbers: Float32Array | Uint32Array, threshold: number): Uint32Array {
  const found = new Uint32Array(numbers.length);
  let count = 0;
  numbers.forEach((number, index) => {
    if (number >= threshold) found[count++] = index;
  });
  return found.subarray(0, count);
}

// Notes viewpoints that are so far from the cloud that their coordinates are probably of another system.

/** How many extents of the cloud a viewpoint may be from it. The cloud then fills half a degree of the view. */
const FAR = 100;

/** Undefined if all viewpoints are near enough. */
export function farNote(positions: Float32Array | Float64Array, question: Question): string | undefined {
  const box = boxOf(positions);
  const extent = Math.hypot(...box.map(([low, high]) => high - low));
  const viewpoints = viewpointsOf(question);
  const far = viewpoints
    .map(({ name, viewpoint }) => ({ name, distance: distanceTo(box, viewpoint) }))
    .filter(({ distance }) => extent > 0 && distance > FAR * extent);
  const [first] = far;
  if (first === undefined) return undefined;
  const others = far.length > 1 ? ` (of ${viewpoints.length} viewpoints, ${far.length} are as far)` : "";
  return `note: ${first.name} is ${said(first.distance)} units from the cloud, whose extent is ${said(extent)}${others}`;
}

function viewpointsOf({ seats }: Question): { name: string; viewpoint: readonly number[] }[] {
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

// Reads the images of cameras with sharp.

const ENDINGS = ["", ".jpg", ".jpeg", ".png", ".JPG", ".JPEG", ".PNG"];

/**
 * The pixels of an image as they are in the file: gray ones of 8 or 16 bits, and otherwise red, green and blue. The file is
 * found in the folder by the name that the camera gives, with or without the folders in it, and the ending.
 */
async function readImage(folder: string, image: string): Promise<TransferImage> {
  const name = await fileOf(folder, image);
  const { default: sharp } = await import("sharp").catch((cause: unknown) => {
    throw new InputProblem("--images reads images with sharp: npm install sharp", { cause });
  });
  try {
    const found = sharp(name);
    const { space, depth, hasAlpha } = await found.metadata();
    const isGray = /^(b-w|grey16)$/.test(space) && !hasAlpha;
    const pixels = found.toColourspace(isGray ? space : "srgb");
    const isDeep = isGray && depth === "ushort";
    const { data, info } = await pixels
      .raw({ depth: isDeep ? "ushort" : "uchar" })
      .toBuffer({ resolveWithObject: true });
    const { width, height, channels } = info;
    // The bytes are copied, so that they start where 16 bits may start.
    const bytes = Uint8Array.from(data);
    return { data: isDeep ? new Uint16Array(bytes.buffer) : bytes, width, height, channels };
  } catch (cause) {
    throw new InputProblem(`${name} cannot be read: ${(cause as Error).message}`, { cause });
  }
}

async function fileOf(folder: string, image: string): Promise<string> {
  const named = image.replaceAll("\\", "/");
  // The name comes from a file of cameras, which may be anybody's.
  const inside = relative(folder, join(folder, named));
  if (inside === ".." || inside.startsWith(`..${sep}`) || isAbsolute(named)) {
    throw new InputProblem(`the image ${image} of a camera lies outside of ${folder}`);
  }
  for (const name of new Set([named, basename(named)])) {
    for (const ending of ENDINGS) {
      const path = join(folder, name + ending);
      if ((await stat(path).catch(() => undefined))?.isFile() === true) return path;
    }
  }
  throw new InputProblem(image === "" ? "a camera has no image" : `${folder} has no image ${image}`);
}
