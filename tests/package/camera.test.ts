import { PerspectiveCamera, OrthographicCamera, Vector3 } from "three";
import { expect, it } from "vitest";

import { bumpySphere, readyPackage } from "./support";

const { PointCloud, WorkerPointCloud, cameraFromPose, cameraFromThree, intrinsicsFromFieldOfView } =
  await readyPackage();

const positions = bumpySphere(5, 6000);
const place = [0.3, 0.8, 2.5];

function threeCamera(): PerspectiveCamera {
  const camera = new PerspectiveCamera(40, 640 / 480, 0.5, 2.6);
  camera.position.set(place[0]!, place[1]!, place[2]);
  camera.lookAt(0.2, 0.1, 0);
  camera.zoom = 1.3;
  camera.setViewOffset(640, 480, 40, -30, 640, 480);
  camera.updateMatrixWorld();
  return camera;
}

it("a camera of three.js sees what its projection puts into the image", () => {
  const cloud = new PointCloud(positions);
  const three = threeCamera();
  const seen = cloud.visibleFromCamera(cameraFromThree(three, 640, 480));
  const whole = cloud.visibleFrom(place);
  const expected: number[] = [];
  for (const index of whole.indices) {
    const at = new Vector3().fromArray(positions, 3 * index).project(three);
    const [u, v] = [((at.x + 1) / 2) * 640, ((1 - at.y) / 2) * 480];
    if (u >= 0 && u < 640 && v >= 0 && v < 480 && Math.abs(at.z) <= 1) {
      expect(seen.pixels[2 * expected.length]).toBeCloseTo(u, 3);
      expect(seen.pixels[2 * expected.length + 1]).toBeCloseTo(v, 3);
      const depth = -new Vector3().fromArray(positions, 3 * index).applyMatrix4(three.matrixWorldInverse).z;
      expect(seen.depths[expected.length]).toBeCloseTo(depth, 5);
      expected.push(index);
    }
  }
  expect(Array.from(seen.indices)).toEqual(expected);
  expect(expected.length).toBeGreaterThan(100);
  expect(expected.length).toBeLessThan(whole.count);
  expect([seen.radius, seen.exact, seen.count]).toEqual([whole.radius, true, expected.length]);
  expect([seen.pixels.length, seen.depths.length]).toEqual([2 * expected.length, expected.length]);
  cloud.dispose();
});

it("a pose and a field of view make the same camera", () => {
  const cloud = new PointCloud(positions);
  const three = new PerspectiveCamera(50, 2, 0.01, 100);
  three.position.fromArray(place);
  three.lookAt(0, 0.1, 0);
  three.updateMatrixWorld();
  const { x, y, z, w } = three.quaternion;
  const intrinsics = intrinsicsFromFieldOfView(50, 800, 400);
  const posed = cameraFromPose(place, [2 * x, 2 * y, 2 * z, 2 * w], intrinsics, "opengl");
  const [one, other] = [posed, cameraFromThree(three, 800, 400)].map((camera) => cloud.visibleFromCamera(camera));
  expect(one!.indices).toEqual(other!.indices);
  one!.pixels.forEach((pixel, i) => {
    expect(pixel).toBeCloseTo(other!.pixels[i]!, 2);
  });
  cloud.dispose();
});

it("workers see the same, also when they share the view", async () => {
  const cloud = new PointCloud(positions);
  const camera = cameraFromThree(threeCamera(), 640, 480);
  for (const workers of [1, 3]) {
    const remote = await WorkerPointCloud.create(positions, { workers });
    for (const options of [{}, { exponent: 3 }, { vote: 5 }, { looks: 2 as const }, { within: { distance: 2.2 } }]) {
      const [answer, expected] = [
        await remote.visibleFromCamera(camera, options),
        cloud.visibleFromCamera(camera, options),
      ];
      expect(answer.indices).toEqual(expected.indices);
      expect(answer.pixels).toEqual(expected.pixels);
      expect(answer.depths).toEqual(expected.depths);
    }
    await remote.dispose();
  }
  cloud.dispose();
});

it("what is no camera is refused", () => {
  const cloud = new PointCloud(positions);
  const good = cameraFromThree(threeCamera(), 640, 480);
  const matrix = Array.from(good.matrix);
  const bad: [object, string, RegExp][] = [
    [{ fx: "5" }, "viewpoint", /fx must be a number/],
    [{ fx: 0 }, "viewpoint", /fx must be finite and positive, got 0/],
    [{ width: undefined }, "viewpoint", /width must be a number, got undefined/],
    [{ height: NaN }, "viewpoint", /height must be finite and positive, got NaN/],
    [{ matrix: matrix.slice(1) }, "viewpoint", /matrix must be 16 numbers, got 15 of them/],
    [{ matrix: matrix.map((x) => 2 * x) }, "viewpoint", /rotation and a translation/],
    [{ matrix: matrix.map((x, i) => (i === 12 ? NaN : x)) }, "viewpoint", /matrix must be/],
    [{ distortion: [1] }, "viewpoint", /distortion must be 5 numbers/],
    [{ near: -1 }, "viewpoint", /near/],
    [{ far: 0.1 }, "viewpoint", /far must be at least near/],
    [{ convention: "vulkan" }, "option", /convention must be "opencv" or "opengl"/],
    [{ distorsion: [0, 0, 0, 0, 0] }, "option", /unknown option "distorsion"/],
  ];
  for (const [change, code, message] of bad) {
    const ask = () => cloud.visibleFromCamera({ ...good, ...change });
    expect(ask).toThrow(expect.objectContaining({ code }));
    expect(ask).toThrow(message);
  }
  for (const none of [undefined, 5, "camera"]) {
    expect(() => cloud.visibleFromCamera(none as never)).toThrow(expect.objectContaining({ code: "viewpoint" }));
  }
  const orthographic = new OrthographicCamera() as unknown as PerspectiveCamera;
  const lens = intrinsicsFromFieldOfView(50, 4, 3);
  for (const make of [
    () => cameraFromThree(orthographic, 4, 3),
    () => cameraFromThree(threeCamera(), 0, 3),
    () => intrinsicsFromFieldOfView(180, 4, 3),
    () => intrinsicsFromFieldOfView(50, 4, NaN),
    () => cameraFromPose([0, 0], [0, 0, 0, 1], lens),
    () => cameraFromPose([0, 0, 0], [0, 0, 0, 0], lens),
  ]) {
    expect(make).toThrow(expect.objectContaining({ code: "viewpoint" }));
  }
  const flat = new PointCloud(positions.subarray(0, 20), { dimension: 2 });
  expect(() => flat.visibleFromCamera(good)).toThrow(/visibleFromCamera needs a cloud of dimension 3, not 2/);
  flat.dispose();
  cloud.dispose();
});
