import { PerspectiveCamera } from "three";
import { describe, expect, it } from "vitest";

import { bumpySphere, expectRefusal, readyPackage } from "./support";

const { PointCloud, cameraFromPose, cameraFromThree, transfer } = await readyPackage();
const { WorkerPointCloud } = await import("hidden-point-removal/worker");

const positions = bumpySphere(5, 3000);
const cloud = new PointCloud(positions);
const size = { width: 64, height: 48 };
const cameras = [0, 1, 2].map((i) => {
  const three = new PerspectiveCamera(60, 64 / 48, 0.1, 100);
  three.position.set(3 + i, i - 1, 0.5 * i);
  three.lookAt(0, 0, 0);
  return cameraFromThree(three, 64, 48);
});

/** One number for each pixel. */
function image(value: (x: number, y: number) => number) {
  return { data: Float32Array.from({ length: 64 * 48 }, (_, i) => value(i % 64, Math.floor(i / 64))), ...size };
}

it("workers share the cameras, and give the same values", async () => {
  const images = [image((x, y) => x + 100 * y), image((x, y) => 7 * x - y), image(() => 5)];
  const remote = await WorkerPointCloud.create(positions, { workers: 2 });
  for (const options of [{}, { merge: "median", weights: "score" }, { exponent: 3, merge: "best" }] as const) {
    const heard: number[] = [];
    const onProgress = (share: number) => heard.push(share);
    expect(await transfer(remote, cameras, images, { ...options, onProgress })).toEqual(
      transfer(cloud, cameras, images, options),
    );
    expect(heard.at(-1)).toBe(1);
  }
  const signal = AbortSignal.abort();
  await expect(transfer(remote, cameras, images, { signal })).rejects.toMatchObject({ name: "AbortError" });
  await expect(transfer(remote, cameras, [])).rejects.toMatchObject({ code: "option" });
  await remote.dispose();
});

it("bad images and options are refused", async () => {
  const good = cameras.map(() => image(() => 1));
  const bad: [unknown, object, string, RegExp][] = [
    [good.slice(1), {}, "option", /one image for each of 3 cameras/],
    [[good[0], good[0], null], {}, "option", /images\[2\] must be an image/],
    [[good[0], good[0], { ...size, data: [1] }], {}, "option", /images\[2\] must have a typed array/],
    [[good[0], good[0], { ...good[0]!, width: 3 }], {}, "option", /size of its camera/],
    [[good[0], good[0], { data: new Uint8Array(5), ...size }], {}, "option", /same number of numbers/],
    [[good[0], good[0], { data: new Uint8Array(3 * 64 * 48), ...size }], {}, "option", /1 channels as the first/],
    [good, { merge: "max" }, "option", /merge must be "mean", "median", "vote" or "best"/],
    [good, { weights: "none" }, "option", /weights must be "distance", "angle" or "score"/],
    [good, { merge: "vote", sampling: "bilinear" }, "option", /cannot be combined/],
    [good, { looks: 3, scores: true }, "option", /scores cannot be combined/],
    [good, { weights: "score", exponent: 3 }, "option", /scores can be given only with looks/],
    [good, { colour: 1 }, "option", /unknown option/],
  ];
  for (const [images, options, code, message] of bad) {
    await expectRefusal(code, message, () => transfer(cloud, cameras, images as never, options));
  }
  expect(() => transfer(cloud, 5 as never, [])).toThrow(expect.objectContaining({ code: "viewpoint" }));
  expect(transfer(cloud, [], []).seen.length).toBe(cloud.length);
});

describe("images come one after another", () => {
  const local = new PointCloud([0, 0, 4, 1, 0, 4, 0, 1, 5]);
  const camera = cameraFromPose([0, 0, 0], [0, 0, 0, 1], { fx: 1, fy: 1, cx: 1, cy: 1, width: 2, height: 2 });
  const four = [camera, camera, camera, camera];
  const of = (...numbers: number[]) => ({ data: Float32Array.from(numbers), width: 2, height: 2 });
  it("from a generator, each after its camera was asked", async () => {
    const remote = await WorkerPointCloud.create([0, 0, 4, 1, 0, 4, 0, 1, 5], { workers: 2 });
    for (const cloud of [local, remote]) {
      let told: string[] = [];
      function* images() {
        try {
          for (const k of [1, 2, 3, 6]) {
            told.push(`image ${k}`);
            yield of(k, k, k, k);
          }
        } finally {
          told.push("end");
        }
      }
      const onProgress = () => told.push("view");
      const ask = (options: object) =>
        cloud === local ? transfer(local, four, images(), options) : transfer(remote, four, images(), options);
      expect([...(await ask({ onProgress })).values]).toEqual([3, 3, 3]);
      if (cloud === local) {
        expect(told.slice(0, 4)).toEqual(["image 1", "view", "image 2", "view"]);
      }
      expect(told.slice(-1)).toEqual(["end"]);
      told = [];
      await expect((async () => ask({ radius: 1 }))()).rejects.toMatchObject({ code: "radius" });
    }
    await remote.dispose();
  });

  it("too few, too many, and a generator that throws", async () => {
    const remote = await WorkerPointCloud.create([0, 0, 4, 1, 0, 4, 0, 1, 5], { workers: 2 });
    const fault = new RangeError("no such photo");
    function* images(count: number) {
      for (let k = 0; k < count; k++) yield of(1, 1, 1, 1);
      if (count === 2) throw fault;
    }
    for (const ask of [
      (count: number) => transfer(local, four, images(count)),
      (count: number) => transfer(remote, four, images(count)),
    ]) {
      await expectRefusal("option", /one image for each of 4 cameras, got 3 of them/, () => ask(3));
      await expectRefusal("option", /one image for each of 4 cameras, got more/, () => ask(5));
      await expect((async () => ask(2))()).rejects.toBe(fault);
      expect((await ask(4)).seen).toEqual(Uint32Array.of(4, 4, 4));
    }
    await remote.dispose();
  });

  it("integers stay what they are, in every type", () => {
    const label = 2 ** 24 + 1;
    for (const Type of [Int32Array, Uint32Array, Float64Array]) {
      for (const merge of ["vote", "best", "median", "mean"] as const) {
        const { values } = transfer(local, [camera], [{ ...of(), data: new Type(4).fill(label) }], { merge });
        expect(values).toEqual(Float64Array.of(label, label, label));
      }
    }
    for (const Type of [Int8Array, Int16Array, Uint16Array, Uint8Array, Uint8ClampedArray]) {
      const { values } = transfer(local, [camera], [{ ...of(), data: new Type(4).fill(7) }]);
      expect(values).toEqual(Float32Array.of(7, 7, 7));
    }
  });
});
