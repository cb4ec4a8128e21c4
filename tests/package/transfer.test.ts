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

/** The values of each point, camera after camera. */
function valuesBy(images: ReturnType<typeof image>[]): { value: number; depth: number }[][] {
  const all: { value: number; depth: number }[][] = Array.from({ length: cloud.length }, () => []);
  cameras.forEach((camera, number) => {
    const { indices, pixels, depths } = cloud.visibleFromCamera(camera, { looks: 3 });
    indices.forEach((index, k) => {
      const value = images[number]!.data[64 * Math.floor(pixels[2 * k + 1]!) + Math.floor(pixels[2 * k]!)]!;
      all[index]!.push({ value, depth: depths[k]! });
    });
  });
  return all;
}

it("takes the values of the nearest pixels, and merges them", () => {
  const images = [image((x, y) => x + 100 * y), image((x, y) => 7 * x - y), image(() => 5)];
  const all = valuesBy(images);
  const expected = {
    median: all.map((list) => {
      const sorted = list.map(({ value }) => value).sort((a, b) => a - b);
      const at = (sorted.length - 1) / 2;
      return sorted.length === 0 ? NaN : (sorted[Math.floor(at)]! + sorted[Math.ceil(at)]!) / 2;
    }),
    mean: all.map((list) => list.reduce((sum, { value }) => sum + value, 0) / list.length),
    best: all.map((list) => list.reduce((a, b) => (b.depth < a.depth ? b : a), { value: NaN, depth: Infinity }).value),
  };
  for (const merge of ["median", "mean", "best"] as const) {
    const { values, channels, seen } = transfer(cloud, cameras, images, { merge });
    expect([channels, seen]).toEqual([1, Uint32Array.from(all, (list) => list.length)]);
    expect(values).toEqual(Float32Array.from(expected[merge]));
    expect(seen.filter((count) => count > 1).length).toBeGreaterThan(500);
    expect(seen.filter((count) => count === 0).length).toBeGreaterThan(500);
  }
});

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

it("labels are voted for, and never mixed", () => {
  const images = [image(() => 3), image(() => 9), image(() => 9)];
  const { values, seen } = transfer(cloud, cameras, images, { merge: "vote" });
  const all = valuesBy(images);
  seen.forEach((count, i) => {
    const nines = all[i]!.filter(({ value }) => value === 9).length;
    const expected = nines > count - nines ? 9 : (all[i]![0]?.value ?? NaN);
    expect(values[i]).toBe(expected);
  });
});

it("alpha 0 and NaN give no value", () => {
  const data = new Uint8ClampedArray(4 * 64 * 48).fill(200);
  const clear = data.map((byte, i) => (i % 4 === 3 ? 0 : byte));
  const { values, channels, seen } = transfer(
    cloud,
    cameras,
    [data, clear, clear].map((data) => ({ data, ...size })),
  );
  const first = cloud.visibleFromCamera(cameras[0]!, { looks: 3 }).mask();
  expect([channels, seen]).toEqual([4, Uint32Array.from(first)]);
  expect(values).toEqual(Float32Array.from({ length: 4 * cloud.length }, (_, i) => (first[i >> 2] === 1 ? 200 : NaN)));
  expect(transfer(cloud, cameras.slice(0, 1), [image(() => NaN)]).seen.every((count) => count === 0)).toBe(true);
});

it("bilinear values follow a ramp, and weights count", () => {
  const ramp = image((x) => x + 0.5);
  const seen = cloud.visibleFromCamera(cameras[0]!, { looks: 3 });
  const { values } = transfer(cloud, cameras.slice(0, 1), [ramp], { sampling: "bilinear" });
  seen.indices.forEach((index, k) => {
    expect(values[index]).toBeCloseTo(seen.pixels[2 * k]!, 3);
  });
  const images = [image(() => 0), image(() => 1), image(() => 0)];
  const all = valuesBy(images);
  const near = transfer(cloud, cameras, images, { merge: "mean", weights: "distance" }).values;
  all.forEach((list, i) => {
    const total = list.reduce((sum, { depth }) => sum + 1 / depth ** 2, 0);
    if (total > 0) {
      expect(near[i]).toBeCloseTo(list.reduce((sum, { value, depth }) => sum + value / depth ** 2, 0) / total, 5);
    }
  });
  for (const weights of ["angle", "score"] as const) {
    const { values } = transfer(cloud, cameras, images, { merge: "mean", weights });
    expect(values.every((value, i) => (all[i]!.length === 0 ? Number.isNaN(value) : value >= 0 && value <= 1))).toBe(
      true,
    );
  }
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

  it("the angle is that of the ray, whatever the lens", () => {
    const angle = (80 * Math.PI) / 180;
    const turn = (20 * Math.PI) / 180;
    const aside = new PointCloud([Math.sin(angle), 0, Math.cos(angle)]);
    const lens = { fx: 100, fy: 100, cx: 200, cy: 200, width: 400, height: 400 };
    const fisheye = cameraFromPose([0, 0, 0], [0, 0, 0, 1], { ...lens, model: "OPENCV_FISHEYE" });
    const turned = cameraFromPose([0, 0, 0], [0, Math.sin(turn / 2), 0, Math.cos(turn / 2)], lens);
    const images = [0, 1].map((x) => ({ data: new Float32Array(160_000).fill(x), width: 400, height: 400 }));
    const [far, near] = [Math.cos(angle), Math.cos(angle - turn)];
    const { values } = transfer(aside, [fisheye, turned], images, { weights: "angle" });
    expect(values[0]).toBeCloseTo(near / (far + near), 5);
  });
});
