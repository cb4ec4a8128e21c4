import type { CameraModel } from "hidden-point-removal";
import { PerspectiveCamera, OrthographicCamera, Vector3 } from "three";
import { expect, it, vi } from "vitest";

import { bumpySphere, expectRefusal, readyPackage } from "./support";

const { PointCloud, WorkerPointCloud, cameraFromPose, cameraFromThree, intrinsicsFromFieldOfView, transfer } =
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

it("what is no camera is refused", async () => {
  const cloud = new PointCloud(positions);
  const good = cameraFromThree(threeCamera(), 640, 480);
  const cameraToWorld = Array.from(good.cameraToWorld);
  const bad: [object, string, RegExp][] = [
    [{ fx: "5" }, "viewpoint", /fx must be a number/],
    [{ fx: 0 }, "viewpoint", /fx must be finite and positive, got 0/],
    [{ width: undefined }, "viewpoint", /width must be a number, got undefined/],
    [{ height: NaN }, "viewpoint", /height must be finite and positive, got NaN/],
    [{ cameraToWorld: cameraToWorld.slice(1) }, "viewpoint", /cameraToWorld must be 16 numbers, got 15 of them/],
    [{ cameraToWorld: cameraToWorld.map((x) => 2 * x) }, "viewpoint", /rotation and a translation/],
    [{ cameraToWorld: cameraToWorld.map((x, i) => (i === 12 ? NaN : x)) }, "viewpoint", /pose must be/],
    [{ worldToCamera: cameraToWorld }, "viewpoint", /exactly one of cameraToWorld and worldToCamera, got both/],
    [{ cameraToWorld: undefined }, "viewpoint", /got neither/],
    [{ matrix: cameraToWorld }, "option", /unknown option "matrix"/],
    [{ distortion: [1] }, "viewpoint", /distortion for OPENCV must be 4 numbers/],
    [{ model: "RADIAL", distortion: [1] }, "viewpoint", /distortion for RADIAL must be 2 numbers, got 1 of them/],
    [{ model: "PINHOLE", distortion: [0, 0, 0, 0] }, "viewpoint", /distortion for PINHOLE must be 0 numbers/],
    [{ model: "FOV", distortion: [4] }, "viewpoint", /from 0 to pi for FOV, got 4/],
    [{ model: "FISHEYE" }, "option", /model must be one of SIMPLE_PINHOLE, .*, got "FISHEYE"/],
    [{ model: 4 }, "option", /model must be one of/],
    [{ near: -1 }, "viewpoint", /near/],
    [{ far: 0.1 }, "viewpoint", /far must be at least near/],
    [{ convention: "vulkan" }, "option", /convention must be "opencv" or "opengl"/],
    [{ distorsion: [0, 0, 0, 0, 0] }, "option", /unknown option "distorsion"/],
  ];
  for (const [change, code, message] of bad) {
    await expectRefusal(code, message, () => cloud.visibleFromCamera({ ...good, ...change }));
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

it("a pose is taken both ways, and the wrong way is said", async () => {
  const away = positions.map((x, i) => x + [10, 20, 30][i % 3]!);
  const cloud = new PointCloud(away);
  const three = threeCamera();
  three.clearViewOffset();
  three.far = 100;
  three.updateProjectionMatrix();
  three.position.set(10.3, 20.8, 34);
  three.lookAt(10, 20, 30);
  three.updateMatrixWorld();
  const { cameraToWorld, ...rest } = cameraFromThree(three, 640, 480);
  const right = cloud.visibleFromCamera({ ...rest, cameraToWorld });
  const worldToCamera = three.matrixWorldInverse.elements;
  expect(right.count).toBeGreaterThan(500);
  expect(right.note).toBeUndefined();
  const both = cloud.visibleFromCamera({ ...rest, worldToCamera });
  expect([both.indices, both.note]).toEqual([right.indices, undefined]);
  const wrong = cloud.visibleFromCamera({ ...rest, cameraToWorld: worldToCamera });
  expect([wrong.count, wrong.note]).toEqual([0, expect.stringContaining("inverse pose")]);
  const remote = await WorkerPointCloud.create(away, { workers: 2 });
  expect((await remote.visibleFromCamera({ ...rest, cameraToWorld: worldToCamera })).note).toBe(wrong.note);
  const bulk = [
    { ...rest, cameraToWorld },
    { ...rest, cameraToWorld: worldToCamera },
  ];
  const images = bulk.map(({ width, height }) => ({ width, height, data: new Uint8Array(width * height * 4) }));
  for (const answer of [cloud.seenBy(bulk), await remote.seenBy(bulk), transfer(cloud, bulk, images)]) {
    expect(answer.note).toBe(`camera 1: ${wrong.note}`);
  }
  expect(cloud.seenBy(bulk.slice(0, 1)).note).toBeUndefined();
  for (const ask of [cloud, remote]) {
    expect((await ask.visibleFromAny(bulk)).note).toBe(wrong.note);
    expect((await ask.placeViewpoints(bulk, { count: 1 })).note).toBe(`camera 1: ${wrong.note}`);
    const warn = vi.spyOn(console, "warn").mockReturnValue();
    await ask.coverage(bulk);
    expect(warn.mock.calls).toEqual([[`camera 1: ${wrong.note}`]]);
    warn.mockRestore();
  }
  await remote.dispose();
  const [x, y, z] = [11, 22, 40];
  expect(cloud.visibleFrom({ x, y, z }).indices).toEqual(cloud.visibleFrom([x, y, z]).indices);
  expect(() => cloud.visibleFrom({ x, y } as never)).toThrow(expect.objectContaining({ code: "viewpoint" }));
  cloud.dispose();
});

/** Cameras around the cloud, each turned to its middle. */
const ring = [0, 1, 2, 3, 4].map((i) => {
  const three = new PerspectiveCamera(30, 640 / 480, 0.1, 100);
  three.position.set(3 * Math.cos(i), 3 * Math.sin(i), i - 2);
  three.lookAt(0, 0, 0);
  return cameraFromThree(three, 640, 480);
});

it("a camera that is none is named by its number", () => {
  const cloud = new PointCloud(positions);
  const bad = [...ring, { ...ring[0]!, fx: "5" }] as never;
  for (const ask of [() => cloud.coverage(bad), () => cloud.visibleFromAny(bad), () => cloud.placeViewpoints(bad)]) {
    expect(ask).toThrow(expect.objectContaining({ code: "viewpoint" }));
    expect(ask).toThrow(/\[5\]'s fx must be a number/);
  }
  expect(() => cloud.visibleFromAny(ring, { looks: 3, scores: true })).toThrow(
    /scores cannot be combined with several cameras/,
  );
  cloud.dispose();
});

it("seenBy has a row for each point, and says its progress", () => {
  const cloud = new PointCloud(positions);
  const heard: number[] = [];
  const lenses: [CameraModel, number[]][] = [
    ["PINHOLE", []],
    ["RADIAL", [-0.1, 0.02]],
    ["OPENCV", [-0.1, 0.02, 0.001, -0.002]],
    ["OPENCV_FISHEYE", [-0.1, 0.02, 0.001, -0.002]],
    ["FOV", [0.9]],
  ];
  const many = ring.map((camera, i) => ({ ...camera, model: lenses[i]![0], distortion: lenses[i]![1] }));
  const onProgress = (share: number) => heard.push(share);
  const { offsets, cameras, pixels, towards } = cloud.seenBy(many, { looks: 3, onProgress });
  expect(heard).toEqual([0.2, 0.4, 0.6, 0.8, 1]);
  const rows = Array.from({ length: cloud.length }, (): number[][] => []);
  for (const [number, camera] of many.entries()) {
    const seen = cloud.visibleFromCamera(camera, { looks: 3 });
    seen.indices.forEach((index, k) => rows[index]!.push([number, ...seen.pixels.subarray(2 * k, 2 * k + 2), index]));
  }
  const entries = rows.flat();
  let before = 0;
  expect([...offsets]).toEqual([0, ...rows.map((row) => (before += row.length))]);
  expect([...cameras]).toEqual(entries.map(([number]) => number));
  expect([...pixels]).toEqual(entries.flatMap(([, u, v]) => [u, v]));
  const off = entries.flatMap(([number, , , index], entry) => {
    const v = [0, 1, 2].map((axis) => many[number!]!.cameraToWorld[12 + axis]! - positions[3 * index! + axis]!);
    return v.map((x, axis) => Math.abs(x / Math.hypot(...v) - towards[3 * entry + axis]!));
  });
  expect([towards.length, Math.max(...off) < 1e-6]).toEqual([3 * entries.length, true]);
  expect(entries.length).toBeGreaterThan(2000);
  expect(cloud.seenBy([]).offsets).toEqual(new Uint32Array(cloud.length + 1));
  for (const bad of [undefined, {}, [5], [ring[0], null]]) {
    expect(() => cloud.seenBy(bad as never)).toThrow(expect.objectContaining({ code: "viewpoint" }));
  }
  expect(() => cloud.seenBy(ring, { looks: 3, scores: true })).toThrow(expect.objectContaining({ code: "option" }));
  expect(() => {
    cloud.dispose();
    cloud.seenBy(ring);
  }).toThrow(expect.objectContaining({ code: "disposed" }));
});
