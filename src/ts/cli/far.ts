// Notes viewpoints that are so far from the cloud that their coordinates are probably of another system.
import { type ImageCamera, isCamera } from "../query/camera.js";
import type { Question } from "./ask.js";

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
