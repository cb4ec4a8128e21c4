import { Vector3 } from "three";
import { upVector } from "../cloud/cloud.ts";
import { pressed } from "../controls/keys.ts";
import type { Viewpoint } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";
import { inFile, inLocal } from "../view/framing.ts";
import { placeAt } from "../view/place.ts";
import type { Viewer } from "../view/viewer.ts";

/** The angle of a turn for each press of a key, in radians. */
const TURN = Math.PI / 36;
/** A light that is moved nearer keeps this share of its distance. */
const NEARER = 0.92;
/** The places of the first lights, as shares of the picture's width and height: visible, and away from the middle. */
const SPOTS = [
  [0.16, 0.16],
  [0.76, 0.2],
  [0.2, 0.84],
  [0.8, 0.84],
] as const;
/** Each further ring of places is this much nearer to the middle. */
const INWARDS = 0.8;
/** Lights nearer to each other than this share of their distance can't be told apart. */
const APART = 0.04;
/** The distance of a new light, as a share of the distance to the camera's target. */
const AHEAD = 0.7;

/** Adds a light that suits the present picture: in front of the cloud and to a side. */
export function addLight(store: Store, viewer: Viewer): void {
  const { cloud, viewpoint } = viewer;
  if (!cloud) return;
  const { lights } = store.current;
  const target = viewer.target ?? cloud.center;
  const like = viewpoint.map((value, axis) => value + AHEAD * (target[axis]! - value)) as Viewpoint;
  const { width, height } = viewer.stage.size;
  const gap = APART * new Vector3(...like).distanceTo(new Vector3(...viewpoint));
  for (let i = 0; ; i++) {
    const inwards = INWARDS ** Math.floor(i / SPOTS.length);
    const [x, y] = SPOTS[i % SPOTS.length]!.map((share) => 0.5 + inwards * (share - 0.5)) as [number, number];
    const place = placeAt(viewer, x * width, y * height, like);
    const isFree = lights.every((light) => new Vector3(...light).distanceTo(new Vector3(...place)) > gap);
    // After this number of tries the place is used even if it is not free: then many lights are in the middle.
    if (!isFree && i <= 2 * lights.length) continue;
    store.change({ lights: [...lights, place] });
    return;
  }
}

/** Arrow keys turn a light around the middle of the cloud; plus and minus move it nearer and farther. */
export function lightByKey(event: KeyboardEvent, i: number, store: Store, viewer: Viewer): void {
  const { cloud } = viewer;
  const found = pressed(event, ["light"]);
  if (!cloud || !found) return;
  event.preventDefault();
  event.stopPropagation();
  const lights = [...store.current.lights];
  const place = inLocal(cloud, lights[i]!);
  const up = new Vector3(...upVector(store.current.up));
  const around = up.clone().cross(place);
  // A light straight above has no sideways axis of its own, so it takes the axis of the camera.
  if (around.lengthSq() < 1e-9 * place.lengthSq()) around.setFromMatrixColumn(viewer.stage.camera.matrixWorld, 0);
  const [sideways, upwards, farther] = STEPS[found.nth]!;
  place
    .applyAxisAngle(up, sideways * TURN)
    .applyAxisAngle(around.normalize(), upwards * TURN)
    .multiplyScalar(farther);
  lights[i] = inFile(cloud, place);
  store.change({ lights });
}

/** The steps, in the order of the keys: left, right, up, down, plus, plus without Shift, minus. */
const STEPS: readonly [sideways: number, upwards: number, farther: number][] = [
  [-1, 0, 1],
  [1, 0, 1],
  [0, -1, 1],
  [0, 1, 1],
  [0, 0, NEARER],
  [0, 0, NEARER],
  [0, 0, 1 / NEARER],
];
