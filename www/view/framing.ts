import { Vector3 } from "three";
import { type Cloud, type Up, upVector } from "../cloud/cloud.ts";
import type { Sample } from "../samples/samples.ts";
import { REACH } from "../settings/limits.ts";
import type { Settings, Viewpoint } from "../settings/settings.ts";
import type { Pose } from "./navigation.ts";

/** The first view of a cloud: the camera's pose, and its place in the file's coordinates. */
export interface Home {
  pose: Pose;
  viewpoint: Viewpoint;
  /** The ball in which everything is drawn: its middle in the recentered coordinates, and its radius. */
  extent: { middle: Vector3; radius: number };
}

/** The vertical field of view in degrees, the ratio width ÷ height, and what is covered. */
export interface Lens {
  fov: number;
  aspect: number;
  /** The share of the height, from the top, that nothing covers. */
  free: number;
}

/** The first direction for files without a chosen view: a little from the side and from above. */
const FROM: Record<Up, [number, number, number]> = { y: [0.55, 0.4, 1], z: [0.55, -1, 0.5], "-y": [0.3, -0.25, -1] };

/** Width by height of a picture that shows little beside its middle. */
const NARROW = 0.8;

/** A view that was asked for. Without a target the camera looks at the middle of the cloud. */
export interface AskedView {
  at: Viewpoint;
  target: Viewpoint | null;
}

/**
 * Returns the view that was asked for, else the sample's own view, else a view of the cloud: without points that lie far
 * away from all others, unless the `whole` cloud is asked for.
 */
export function findHome(
  cloud: Cloud,
  up: Up,
  sample: Sample | null,
  view: AskedView | null,
  lens: Lens,
  whole = false,
): Home {
  const upward = new Vector3(...upVector(up));
  const all = { middle: new Vector3(), radius: cloud.radius };
  // The pose comes from the viewpoint, so whoever comes back to that place is in the first view again, to the last bit.
  const at = (viewpoint: Viewpoint, target: Vector3, extent = all) => ({
    pose: { at: inLocal(cloud, viewpoint), target, up: upward },
    viewpoint,
    extent,
  });

  if (view) {
    const from = inLocal(cloud, view.at);
    const target = view.target ? inLocal(cloud, view.target) : new Vector3();
    // The camera stands at its target and cannot turn to it: it looks ahead.
    const ahead = from.distanceTo(target) > 1e-6 * cloud.radius;
    return at(view.at, ahead ? target : from.add(new Vector3(...FROM[up]).setLength(-0.1 * cloud.radius)));
  }
  if (sample?.eye) {
    const { at: eye, target, narrow = target } = sample.eye;
    return at(eye, inLocal(cloud, lens.aspect < NARROW ? narrow : target));
  }

  const body = whole ? null : cloud.body;
  const extent = body ? { middle: new Vector3(...body.middle), radius: Math.hypot(...body.size) } : all;
  const from = new Vector3(...(sample?.direction ?? FROM[up])).normalize();
  const local = from.clone().multiplyScalar(1.07 * fittingDistance(cloud, extent, from, upward, lens));
  local.add(extent.middle);
  return at(inFile(cloud, local), extent.middle.clone(), extent);
}

/** A target as high as a station, in the direction of its points. The middle of a scan is often the ground under the station. */
export function levelFrom(cloud: Cloud, station: Viewpoint, up: Up): Viewpoint {
  const from = inLocal(cloud, station);
  const [sum, point] = [new Vector3(), new Vector3()];
  for (let i = 0; i < cloud.count; i++) sum.add(point.fromArray(cloud.local, 3 * i).sub(from));
  const ahead = sum.projectOnPlane(new Vector3(...upVector(up)));
  return inFile(cloud, from.add(ahead.setLength(cloud.radius)));
}

/**
 * Keeps the places from which a cloud is larger than a pixel, and says in notes that the others are not. `asked`: "in the
 * address".
 */
export function inReachOnly(
  cloud: Cloud,
  view: AskedView | null,
  { freeze }: Partial<Settings>,
  asked: string,
): { view: AskedView | null; places: Partial<Settings>; notes: string[] } {
  const notes: string[] = [];
  const isNear = (place: Viewpoint, called: string, otherwise: string) => {
    const reached = inLocal(cloud, place).length() <= REACH * cloud.radius;
    if (!reached) notes.push(`The ${called} ${asked} is too far away, so ${otherwise}.`);
    return reached;
  };
  const isKept = view !== null && isNear(view.at, "view", "the usual view is used");
  const looks = isKept && view.target && isNear(view.target, "target", "the camera looks at the middle");
  const isFrozen = !freeze || isNear(freeze, "frozen viewpoint", "the viewpoint goes with the camera");
  return {
    view: isKept ? { at: view.at, target: looks ? view.target : null } : null,
    places: isFrozen ? {} : { freeze: null },
    notes,
  };
}

export function inLocal({ center }: Cloud, place: Viewpoint): Vector3 {
  return new Vector3(place[0] - center[0], place[1] - center[1], place[2] - center[2]);
}

/** Converts the recentered coordinates to the coordinates of the file. */
export function inFile(cloud: Cloud, local: Vector3): Viewpoint {
  return [local.x + cloud.center[0], local.y + cloud.center[1], local.z + cloud.center[2]];
}

/** The number of points by which a cloud is framed. With fewer of them, a thin part may be missed. */
const FRAMED = 100_000;

/**
 * The least distance along `from` at which the points of the extent are in the picture. Of a large cloud, an even share is
 * looked at.
 */
function fittingDistance(
  { local, count }: Cloud,
  { middle, radius }: Home["extent"],
  from: Vector3,
  up: Vector3,
  { fov, aspect, free }: Lens,
): number {
  const tangent = Math.tan((fov * Math.PI) / 360);
  const right = up.clone().cross(from).normalize();
  const above = from.clone().cross(right);
  const point = new Vector3();
  let distance = 0.1 * radius;
  for (let i = 0; i < count; i += Math.ceil(count / FRAMED)) {
    point.fromArray(local, 3 * i).sub(middle);
    if (point.length() > 1.0001 * radius) continue;
    const sideways = Math.max(Math.abs(point.dot(right)) / aspect, Math.abs(point.dot(above)) / free) / tangent;
    distance = Math.max(distance, point.dot(from) + sideways);
  }
  return distance;
}
