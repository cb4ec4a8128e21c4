import { afterEach, describe, expect, it, vi } from "vitest";

import { bumpySphere, freshPackage, problemOf, readyPackage, wasmBytes } from "./support";
import { trappingWasm } from "./trapping-wasm";

const sphere = bumpySphere(1, 500);
const farAway = [0, 0, 5];
const broken = trappingWasm("visibleFrom");

afterEach(() => {
  vi.restoreAllMocks();
});

async function trapped() {
  const hpr = await freshPackage();
  hpr.initSync(broken);
  const [cloud, other] = [new hpr.PointCloud(sphere), new hpr.PointCloud(sphere)];
  const problem = await problemOf(() => cloud.visibleFrom(farAway));
  return { hpr, cloud, other, problem };
}

describe("a trap", () => {
  it("is reported as internal, with the trap as its cause", async () => {
    const { problem } = await trapped();
    expect(problem.code).toBe("internal");
    expect(problem.cause).toBeInstanceOf(WebAssembly.RuntimeError);
    expect(problem.message).toMatch(/init\(\)/);
  });

  it("ends all clouds of the instance, not only the cloud that trapped", async () => {
    const { cloud, other, hpr } = await trapped();
    for (const lost of [cloud, other]) {
      expect((await problemOf(() => lost.visibleFrom(farAway))).code).toBe("internal");
      expect((await problemOf(() => lost.autoRadius(farAway))).code).toBe("internal");
    }
    expect((await problemOf(() => new hpr.PointCloud(sphere))).code).toBe("not-initialised");
    expect((await problemOf(() => hpr.hiddenPointRemoval(sphere, farAway))).code).toBe("not-initialised");
  });

  const restarts: [name: string, restart: (hpr: Awaited<ReturnType<typeof freshPackage>>) => unknown][] = [
    ["init()", (hpr) => hpr.init()],
    ["init() with bytes", (hpr) => hpr.init(wasmBytes())],
    [
      "initSync()",
      (hpr) => {
        hpr.initSync(wasmBytes());
      },
    ],
  ];
  it.each(restarts)("is over after %s: new clouds work, and old clouds do not affect them", async (_, restart) => {
    const { hpr, cloud, other } = await trapped();
    await restart(hpr);
    const fresh = [1, 2, 3].map((seed) => new hpr.PointCloud(bumpySphere(seed, 500)));
    const answers = fresh.map((one) => one.visibleFrom(farAway).indices);
    expect((await problemOf(() => cloud.visibleFrom(farAway))).code).toBe("internal");
    cloud.dispose();
    other.dispose();
    other.dispose();
    expect((await problemOf(() => other.visibleFrom(farAway))).code).toBe("disposed");
    expect(fresh.map((one) => one.visibleFrom(farAway).indices)).toEqual(answers);

    const untouched = await freshPackage();
    await untouched.init();
    expect(untouched.hiddenPointRemoval(bumpySphere(1, 500), farAway).indices).toEqual(answers[0]);
  });

  it("may happen again and again, in memories of different sizes", async () => {
    const [hpr, untouched] = [await freshPackage(), await readyPackage()];
    const module = new WebAssembly.Module(trappingWasm("autoRadius"));
    for (const size of [1000, 80_000, 300, 40_000]) {
      hpr.initSync(module);
      const points = bumpySphere(size, size);
      const cloud = new hpr.PointCloud(points);
      expect(cloud.visibleFrom(farAway)).toEqual(untouched.hiddenPointRemoval(points, farAway));
      expect((await problemOf(() => cloud.autoRadius(farAway))).code).toBe("internal");
    }
  });

  it("compiles the package's own file only once, for any number of starts", async () => {
    const hpr = await freshPackage();
    const compile = vi.spyOn(WebAssembly, "compile");
    const instantiate = vi.spyOn(WebAssembly, "instantiate");
    await hpr.init();
    const cloud = new hpr.PointCloud(sphere);
    // No caller can make the package's own wasm trap. So the test makes the next call out
    // of the wasm trap.
    const set = vi.spyOn(Uint32Array.prototype, "set").mockImplementationOnce(() => {
      throw new WebAssembly.RuntimeError("unreachable");
    });
    expect((await problemOf(() => cloud.visibleFrom(farAway))).code).toBe("internal");
    set.mockRestore();
    await hpr.init();
    expect(new hpr.PointCloud(sphere).visibleFrom(farAway).count).toBeGreaterThan(10);
    expect(compile).toHaveBeenCalledTimes(1);
    expect(instantiate).toHaveBeenCalledTimes(2);
  });
});
