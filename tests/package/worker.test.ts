import type threads from "node:worker_threads";
import { getEventListeners } from "node:events";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { describe, expect, it } from "vitest";
import { OriginalWorker, replaceWorker, watchedWorkers } from "./node-workers";
import { bumpySphere, expectRefusal, freshPackage, problemOf, readyPackage } from "./support";
import { trappingWasm } from "./trapping-wasm";

const { WorkerPointCloud, PointCloud } = await readyPackage();

type WorkerCloud = Awaited<ReturnType<typeof WorkerPointCloud.create>>;

const sphere = bumpySphere(1, 3000);
const farAway = [0, 0, 5];
const loose = (value: unknown) => value as never;

/** All threads that were started, so that a test can end one. */
const started = watchedWorkers();

describe("a cloud in a worker", () => {
  it("needs no init()", async () => {
    const fresh = await freshPackage();
    const cloud = await fresh.WorkerPointCloud.create(sphere);
    expect((await cloud.visibleFrom(farAway)).indices).toEqual(new PointCloud(sphere).visibleFrom(farAway).indices);
  });

  it("runs what init() is loading", async () => {
    const fresh = await freshPackage();
    void fresh.init(trappingWasm("autoRadius"));
    const cloud = await fresh.WorkerPointCloud.create(sphere);
    expect((await problemOf(() => cloud.autoRadius(farAway))).code).toBe("internal");
  });

  it("copies the positions, also from shared memory", async () => {
    const shared = new Float32Array(new SharedArrayBuffer(sphere.byteLength));
    const own = sphere.slice();
    shared.set(sphere);
    const creating = [own, shared].map((positions) => WorkerPointCloud.create(positions));
    own.fill(0);
    shared.fill(0);
    const expected = new PointCloud(sphere).visibleFrom(farAway).indices;
    for (const cloud of await Promise.all(creating)) {
      expect((await cloud.visibleFrom(farAway)).indices).toEqual(expected);
    }
    expect(own).toHaveLength(sphere.length);
  });

  it("takes the buffer itself if the caller gives it away", async () => {
    const own = sphere.slice();
    const creating = WorkerPointCloud.create(own, { transfer: true });
    expect(own).toHaveLength(0);
    const cloud = await creating;
    expect((await cloud.visibleFrom(farAway)).indices).toEqual(new PointCloud(sphere).visibleFrom(farAway).indices);
  });

  it.each([1, 3])("reports the progress of %d workers", async (workers) => {
    for (const positions of [sphere, [], [0, 0, 1]]) {
      const told: number[] = [];
      const onProgress = (fraction: number) => told.push(fraction);
      const cloud = await WorkerPointCloud.create(positions, { workers, onProgress });
      expect([told[0], told.at(-1)]).toEqual([0, 1]);
      // Each worker reports at least two steps: its points are checked, and then sorted.
      expect(told.length).toBeGreaterThan(2 * workers);
      expect(told).toEqual([...new Set(told)].sort((a, b) => a - b));
      await cloud.visibleFrom(farAway);
      await cloud.append([1, 2, 3]);
      expect(told.at(-1)).toBe(1);
      await cloud.dispose();
    }
  });

  it("lets the process end while nothing is pending", async () => {
    const script = `
      const { WorkerPointCloud } = await import("hidden-point-removal/worker");
      const cloud = await WorkerPointCloud.create(Float32Array.from({ length: 300 }, (_, i) => Math.sin(i)));
      console.log((await cloud.visibleFrom([0, 0, 5])).count > 0);`;
    const { spawnSync } = await import("node:child_process");
    const { stdout, status } = spawnSync(process.execPath, ["--input-type=module", "--eval", script], {
      encoding: "utf8",
      cwd: new URL(".", import.meta.url),
    });
    expect([stdout.trim(), status]).toEqual(["true", 0]);
  });
});

describe("a thread", () => {
  it("ends when nothing refers to its cloud any more, but answers what is pending first", async () => {
    setFlagsFromString("--expose-gc");
    const collectGarbage = runInNewContext("gc") as () => void;
    const answer = (await WorkerPointCloud.create(sphere)).visibleFrom(farAway);
    const pause = () => new Promise((next) => setTimeout(next, 10));
    collectGarbage();
    await pause();
    expect((await answer).count).toBeGreaterThan(10);
    // A thread that has ended no longer has a number.
    while (started[0]!.threadId !== -1) {
      collectGarbage();
      await pause();
    }
  });
});

it.each<[names: RegExp, positions: unknown, options: unknown]>([
  [/"progress"/, sphere, { progress: () => undefined }],
  [/transfer/, [1, 2, 3], { transfer: true }],
  [/transfer/, new Float32Array(new SharedArrayBuffer(12)), { transfer: true }],
  [/signal/, sphere, { signal: 1 }],
])("create refuses %s", (names, positions, options) =>
  expectRefusal("option", names, () => WorkerPointCloud.create(loose(positions), loose(options))),
);

describe("requests given up", () => {
  const isAbort = (problem: unknown) => problem instanceof DOMException && problem.name === "AbortError";
  const settled = async (promises: Promise<unknown>[]) =>
    (await Promise.allSettled(promises)).map((one) =>
      one.status === "fulfilled" ? "answered" : isAbort(one.reason) ? "aborted" : String(one.reason),
    );

  /** Counts the messages to workers that start from now on. */
  const counted = () => {
    const count = { posted: 0 };
    replaceWorker(
      class extends OriginalWorker {
        override postMessage(...args: Parameters<threads.Worker["postMessage"]>) {
          count.posted += 1;
          super.postMessage(...args);
        }
      },
    );
    return count;
  };

  it("tell the worker if they are aborted while it works", async () => {
    const count = counted();
    const cloud = await WorkerPointCloud.create(sphere);
    count.posted = 0;
    const abort = new AbortController();
    const asked = cloud.visibleFrom(farAway, { looks: 3, signal: abort.signal });
    abort.abort();
    await expect(asked).rejects.toThrow("abort");
    expect(count.posted).toBe(2);
    const expected = new PointCloud(sphere).visibleFrom(farAway, { looks: 3 });
    expect((await cloud.visibleFrom(farAway, { looks: 3 })).indices).toEqual(expected.indices);
    await cloud.dispose();
  });

  it("end the worker that was being started for a cloud", async () => {
    const controller = new AbortController();
    const creating = settled([WorkerPointCloud.create(sphere, { signal: controller.signal })]);
    controller.abort();
    expect(await creating).toEqual(["aborted"]);
    // A thread that has ended no longer has a number.
    await expect.poll(() => started.map(({ threadId }) => threadId)).toEqual([-1]);
  });

  it("listen to a signal only once together, and only while they are pending", async () => {
    const warnings: string[] = [];
    const warn = ({ name }: Error) => warnings.push(name);
    process.on("warning", warn);
    const cloud = await WorkerPointCloud.create(sphere);
    const controller = new AbortController();
    const { signal } = controller;
    const listening = () => getEventListeners(signal, "abort").length;
    const answered = Array.from({ length: 30 }, () => cloud.visibleFrom(farAway, { signal }));
    expect(listening()).toBe(1);
    expect(await settled(answered)).toEqual(new Array<string>(30).fill("answered"));
    expect(listening()).toBe(0);
    const aborted = Array.from({ length: 30 }, () => cloud.visibleFrom(farAway, { signal }));
    controller.abort();
    aborted.push(cloud.visibleFrom(farAway, { signal }));
    expect(await settled(aborted)).toEqual(new Array<string>(31).fill("aborted"));
    expect(listening()).toBe(0);
    await new Promise((resolve) => setImmediate(resolve));
    process.off("warning", warn);
    expect(warnings).toEqual([]);
  });
});

describe("a worker that is gone", () => {
  const codesOf = async (promises: Promise<unknown>[]) =>
    Promise.all(promises.map(async (promise) => (await problemOf(() => promise)).code));
  const pendingIn = (cloud: WorkerCloud) => [
    cloud.visibleFrom(farAway),
    cloud.visibleFrom(farAway, { latest: true }),
    cloud.autoRadius(farAway),
    cloud.append(sphere),
    cloud.remove([0]),
  ];

  it("rejects everything with internal if it died, and a new cloud works", async () => {
    const [cloud, other] = [await WorkerPointCloud.create(sphere), await WorkerPointCloud.create(sphere)];
    // The worker dies before its first message, however fast it is.
    started[0]!.removeAllListeners("message");
    const pending = codesOf(pendingIn(cloud));
    void started[0]!.terminate();
    expect(await pending).toEqual(Array<string>(5).fill("internal"));
    expect(await codesOf(pendingIn(cloud))).toEqual(Array<string>(5).fill("internal"));
    const next = await WorkerPointCloud.create(sphere);
    expect((await next.visibleFrom(farAway)).indices).toEqual((await other.visibleFrom(farAway)).indices);
    await cloud.dispose();
  });

  it("rejects everything with internal if the wasm trapped", async () => {
    const hpr = await freshPackage();
    // The worker runs the same wasm as the page.
    hpr.initSync(trappingWasm("visibleFrom"));
    const cloud = await hpr.WorkerPointCloud.create(sphere);
    expect((await cloud.autoRadius(farAway)).radius).toBeGreaterThan(0);
    expect(await codesOf(pendingIn(cloud))).toEqual(Array<string>(5).fill("internal"));
    expect(await codesOf([cloud.autoRadius(farAway)])).toEqual(["internal"]);
    // The worker's memory is given back without dispose().
    await expect.poll(() => started[0]!.threadId).toBe(-1);
    expect((await problemOf(() => new hpr.PointCloud(sphere).visibleFrom(farAway))).code).toBe("internal");
    const next = await hpr.WorkerPointCloud.create(sphere);
    expect((await next.visibleFrom(farAway)).count).toBeGreaterThan(10);
  });

  it("rejects with load if it could not be started", async () => {
    replaceWorker(
      class extends OriginalWorker {
        constructor() {
          super(new URL("file:///nowhere/worker-thread.js"));
        }
      },
    );
    const problem = await problemOf(() => WorkerPointCloud.create(sphere));
    expect(problem.code).toBe("load");
    expect(problem.message).toMatch(/worker-thread\.js/);
  });
});

describe("several workers", () => {
  it("all take appended and removed points", async () => {
    const direct = new PointCloud(sphere);
    const cloud = await WorkerPointCloud.create(sphere, { workers: 2 });
    const more = bumpySphere(2, 2000);
    const gone = Uint32Array.from({ length: 900 }, (_, i) => 5 * i);
    direct.append(more);
    const changes = [cloud.append(more)];
    const asked = [cloud.visibleFrom(farAway)];
    const expected = [direct.visibleFrom(farAway)];
    direct.remove(gone);
    changes.push(cloud.remove(gone));
    asked.push(cloud.visibleFrom(farAway));
    expected.push(direct.visibleFrom(farAway));
    await Promise.all(changes);
    expect(cloud).toHaveLength(5000);
    expect(await Promise.all(asked)).toEqual(expected);
    for (const [code, change] of [
      ["non-finite", () => cloud.append([1, NaN, 2])],
      ["option", () => cloud.remove([5000])],
    ] as const) {
      expect((await problemOf(change)).code).toBe(code);
    }
    expect((await problemOf(() => cloud.visibleFrom(farAway, { radius: 1 }))).code).toBe("radius");
    expect(await cloud.visibleFrom(farAway)).toEqual(expected[1]);
  });

  it.each([0, 1, 2])("are all gone when number %i dies, and a new cloud works", async (number) => {
    const cloud = await WorkerPointCloud.create(sphere, { workers: 3 });
    const threadsOfCloud = started.slice();
    // No answer comes before the death, however fast the workers are.
    for (const thread of threadsOfCloud) thread.removeAllListeners("message");
    const asked = [cloud.visibleFrom(farAway), cloud.append(sphere), cloud.autoRadius(farAway)];
    const codes = Promise.all(asked.map(async (one) => (await problemOf(() => one)).code));
    void threadsOfCloud[number]!.terminate();
    expect(await codes).toEqual(["internal", "internal", "internal"]);
    expect((await problemOf(() => cloud.visibleFrom(farAway))).code).toBe("internal");
    await cloud.dispose();
    await expect.poll(() => threadsOfCloud.map(({ threadId }) => threadId)).toEqual([-1, -1, -1]);
    const next = await WorkerPointCloud.create(sphere, { workers: 2 });
    expect((await next.visibleFrom(farAway)).indices).toEqual(new PointCloud(sphere).visibleFrom(farAway).indices);
  });
});

it("a survey can be given up, and a refusal ends it", async () => {
  const remote = await WorkerPointCloud.create(sphere, { workers: 2 });
  const controller = new AbortController();
  let heard = 0;
  const onProgress = () => {
    heard += 1;
    if (heard === 3) controller.abort();
  };
  const many = Array.from({ length: 300 }, (_, i) => [3, i / 100, 0]);
  await expect(remote.coverage(many, { signal: controller.signal, onProgress })).rejects.toMatchObject({
    name: "AbortError",
  });
  const refused = remote.coverage([farAway, [1e9, 0, 0]], { radius: 8 });
  await expect(refused).rejects.toMatchObject({ code: "radius" });
  expect((await remote.coverage([farAway])).length).toBe(3000);
  expect(heard).toBeLessThan(20);
  await remote.dispose();
});
