// A page that runs all day: clouds come and go, and memory runs out. Neither leaves a trace.
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { afterEach, describe, expect, it, vi } from "vitest";

import { cappedWasm } from "./capped-wasm";
import { bumpySphere, freshPackage, problemOf, wasmBytes } from "./support";

const farAway = [0, 0, 5];
const points = bumpySphere(9, 20_000);

afterEach(() => {
  vi.restoreAllMocks();
});

/** The package, and the bytes of its one instance. */
async function measured() {
  const instantiate = vi.spyOn(WebAssembly, "instantiate");
  const hpr = await freshPackage();
  await hpr.init(new WebAssembly.Module(wasmBytes()));
  const instance = (await instantiate.mock.results[0]!.value) as WebAssembly.Instance;
  const { memory } = instance.exports as { memory: WebAssembly.Memory };
  return { hpr, bytes: () => memory.buffer.byteLength };
}

describe("memory stays flat", () => {
  it("over 400 clouds of all kinds that are asked, changed and disposed of", async () => {
    const { hpr, bytes } = await measured();
    const cycle = (i: number) => {
      const count = 300 + (i % 7) * 200;
      const positions = i % 2 === 0 ? points.subarray(0, 3 * count) : Float64Array.from(points.subarray(0, 3 * count));
      const cloud = new hpr.PointCloud(positions);
      expect(cloud.visibleFrom(farAway).count).toBeGreaterThan(10);
      cloud.visibleFrom([0, 0.1, 5]);
      cloud.append(points.slice(0, 300));
      cloud.remove([0, 1, 2]);
      if (i % 10 === 0) {
        cloud.reconstruct(farAway);
        cloud.illuminate([farAway]);
        cloud.visibleFromDirection([0, 0, -1], { looks: 2 });
        expect(() => cloud.visibleFrom(farAway, { radius: 1e-9 })).toThrow();
        new hpr.PointCloud(points.subarray(0, 400), { dimension: 4 }).dispose();
      }
      cloud.dispose();
    };
    for (let i = 0; i < 70; i++) cycle(i);
    const before = bytes();
    for (let i = 70; i < 400; i++) cycle(i);
    expect(bytes()).toBe(before);
  });

  it("over 400 clouds in the worker they share", async () => {
    const hpr = await freshPackage();
    // Memory for the cloud that stays and a few more. A leak soon leads to a refusal.
    hpr.initSync(cappedWasm(120));
    const stays = await hpr.WorkerPointCloud.create(points, { shared: true });
    const { indices } = await stays.visibleFrom(farAway);
    for (let i = 0; i < 400; i++) {
      const cloud = await hpr.WorkerPointCloud.create(points.subarray(0, 3 * (1 + (i % 5) * 300)), { shared: true });
      await cloud.visibleFrom(farAway);
      await cloud.dispose();
    }
    expect((await stays.visibleFrom(farAway)).indices).toEqual(indices);
    await stays.dispose();
  });

  it("in the shared worker, also if clouds are forgotten and not disposed of", async () => {
    setFlagsFromString("--expose-gc");
    const collectGarbage = runInNewContext("gc") as () => void;
    const hpr = await freshPackage();
    hpr.initSync(cappedWasm(120));
    const stays = await hpr.WorkerPointCloud.create(points, { shared: true });
    for (let i = 0; i < 30; i++) {
      await hpr.WorkerPointCloud.create(points, { shared: true });
      collectGarbage();
      await new Promise((next) => setTimeout(next, 5));
    }
    expect((await stays.visibleFrom(farAway)).count).toBeGreaterThan(100);
    await stays.dispose();
  });
});

describe("memory that is refused in a worker", () => {
  it("is too-large there, and the worker and its clouds go on", async () => {
    const hpr = await freshPackage();
    hpr.initSync(cappedWasm(60));
    const small = points.subarray(0, 3000);
    const cloud = await hpr.WorkerPointCloud.create(small, { shared: true });
    const before = await cloud.visibleFrom(farAway);
    const huge = bumpySphere(3, 100_000);
    expect((await problemOf(() => hpr.WorkerPointCloud.create(huge, { shared: true }))).code).toBe("too-large");
    expect((await problemOf(() => cloud.append(huge))).code).toBe("too-large");
    expect(await cloud.visibleFrom(farAway)).toEqual(before);
    const next = await hpr.WorkerPointCloud.create(small, { shared: true });
    expect(await next.visibleFrom(farAway)).toEqual(before);
    await Promise.all([cloud.dispose(), next.dispose()]);
  });

  it("is too-large in a worker of the cloud's own, and the next cloud works", async () => {
    const hpr = await freshPackage();
    hpr.initSync(cappedWasm(60));
    const huge = bumpySphere(3, 100_000);
    expect((await problemOf(() => hpr.WorkerPointCloud.create(huge, { workers: 2 }))).code).toBe("too-large");
    const next = await hpr.WorkerPointCloud.create(points.subarray(0, 3000), { workers: 2 });
    expect((await next.visibleFrom(farAway)).count).toBeGreaterThan(10);
    await next.dispose();
  });
});
