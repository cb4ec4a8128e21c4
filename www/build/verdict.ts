import { init, PointCloud } from "hidden-point-removal";
import { PerspectiveCamera, Vector3 } from "three";
import { prepareCloud } from "../cloud/prepare.ts";
import { oracleFor } from "../compare/oracles.ts";
import { errorsOf, Projected, VISIBLE, zBuffer } from "../compare/zbuffer.ts";
import { makeSample } from "../samples/generators.ts";
import { SAMPLES } from "../samples/samples.ts";
import { clipping } from "../view/stage.ts";
import { inLocal } from "../view/framing.ts";

const [WIDTH, HEIGHT] = [1280, 720];

async function judged(): Promise<string> {
  const { from, eye, fieldOfView, surface, picture } = SAMPLES[0]!;
  if (!("generator" in from) || !eye || !surface) throw new Error("The first sample has no true surface.");
  const { cloud, positions } = prepareCloud(await makeSample(from.generator));
  const camera = new PerspectiveCamera(fieldOfView, WIDTH / HEIGHT);
  camera.position.copy(inLocal(cloud, eye.at));
  camera.lookAt(inLocal(cloud, eye.target));
  Object.assign(camera, clipping(camera.position.distanceTo(new Vector3()), cloud.radius));
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
  const projected = new Projected(cloud.local, {
    matrix: camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse).toArray(),
    width: WIDTH,
    height: HEIGHT,
    near: camera.near,
    pixels: (camera.projectionMatrix.elements[5] * HEIGHT) / 2,
  });
  await init();
  const points = new PointCloud(positions);
  const looks = points.visibleFrom(eye.at, { looks: 3 }).mask();
  const buffered = zBuffer(projected, projected.splatFor(points.spacing)).map((kind) => Number(kind === VISIBLE));
  const sees = (await oracleFor(surface, new Float32Array())).from(eye.at);
  const truth = Uint8Array.from(looks, (_, i) => Number(sees(i)));
  points.dispose();
  const percent = (shown: Uint8Array) => {
    const { wrong, missed } = errorsOf(projected, shown, truth);
    return `${(100 * (wrong + missed)).toFixed(1)} %`;
  };
  return `${picture}: ${percent(looks)} wrong; a z-buffer ${percent(buffered)}`;
}

/** How right the first picture of the page is, by rays to the true surface. */
export const verdict = await judged();
