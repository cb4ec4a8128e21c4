// What a cloud asks of its workers, and what it makes of their answers and deaths.
import { availableParallelism } from "node:os";
import { afterEach, beforeEach, describe, expect, it } from "vitest";

import { found, heldBy, scripted, until, useOwnWorkers, useScriptedWorkers } from "./scripted-workers";
import { bumpySphere, problemOf, readyPackage } from "./support";

const { WorkerPointCloud } = await readyPackage();

const points = bumpySphere(1, 100);
const farAway = [0, 0, 5];

beforeEach(useScriptedWorkers);
afterEach(useOwnWorkers);

const cloudIn = (workers: number) => heldBy(workers, WorkerPointCloud.create(points, { workers }), 100);
const kindsSent = () => scripted.map(({ posted }) => posted.map(({ kind }) => kind));
/** The newest request to each worker. */
const newest = () => scripted.map(({ posted }) => posted.at(-1)!);

function abortable(): { signal: AbortSignal; abort: () => void } {
  const controller = new AbortController();
  return {
    signal: controller.signal,
    abort: () => controller.abort(),
  };
}

describe("a cloud in several workers", () => {
  it("is sent when all of them are ready, to each its own copy", async () => {
    const creating = WorkerPointCloud.create(points, { workers: 3 });
    await until(() => scripted.length === 3);
    scripted[0]!.isReady();
    scripted[2]!.isReady();
    // A request that comes too early has time to be seen.
    for (let turn = 0; turn < 5; turn++) await new Promise((resolve) => setImmediate(resolve));
    expect(kindsSent()).toEqual([[], [], []]);
    scripted[1]!.isReady();
    await until(() => scripted.every(({ posted }) => posted.length === 1));
    for (const { posted, moved } of scripted) {
      expect(posted[0]).toMatchObject({ kind: "create", positions: points, reporting: false });
      expect(moved[0]).toEqual([points.byteLength]);
    }
    for (const worker of scripted) worker.answers({ length: 100, skipped: 2, spacing: 3 });
    const cloud = await creating;
    expect([cloud.length, cloud.skipped, cloud.spacing]).toEqual([100, 2, 3]);
    await cloud.dispose();
    expect(scripted.map(({ isEnded }) => isEnded)).toEqual([true, true, true]);
  });

  it("is not created if one of them ends before all are ready", async () => {
    const creating = WorkerPointCloud.create(points, { workers: 2 });
    await until(() => scripted.length === 2);
    scripted[0]!.isReady();
    scripted[1]!.emit("exit", 3);
    await expect(creating).rejects.toMatchObject({
      code: "load",
      message: expect.stringContaining("exit code 3") as string,
      cause: "it ended with exit code 3",
    });
    expect(scripted[0]!.isEnded).toBe(true);
  });

  it("tells the mean of their progress", async () => {
    const told: number[] = [];
    const creating = WorkerPointCloud.create(points, { workers: 2, onProgress: (share) => told.push(share) });
    await until(() => scripted.length === 2);
    for (const worker of scripted) worker.isReady();
    await until(() => scripted.every(({ posted }) => posted.length === 1));
    expect(newest()).toMatchObject([{ reporting: true }, { reporting: true }]);
    scripted[0]!.says({ progress: 0.5 });
    scripted[1]!.says({ progress: 0.25 });
    scripted[0]!.says({ progress: 1 });
    for (const worker of scripted) worker.answers({ length: 100, skipped: 0, spacing: 1 });
    await (await creating).dispose();
    expect(told).toEqual([0, 0.25, 0.375, 0.625, 1]);
  });

  it("lets the process end unless a request is pending", async () => {
    const cloud = await cloudIn(2);
    const busy = () => scripted.map(({ isBusy }) => isBusy);
    expect(busy()).toEqual([false, false]);
    const asked = cloud.visibleFrom(farAway);
    expect(busy()).toEqual([true, true]);
    for (const worker of scripted) worker.answers(found([], 100));
    await asked;
    expect(busy()).toEqual([false, false]);
  });

  it("names the first death, and no message after its end matters", async () => {
    const cloud = await cloudIn(2);
    scripted[0]!.emit("exit", 7);
    scripted[1]!.emit("exit", 8);
    scripted[1]!.refuses("internal", "a trap");
    const problem = await problemOf(() => cloud.visibleFrom(farAway));
    expect(problem).toMatchObject({ code: "internal", cause: "it ended with exit code 7" });
    expect(problem.message).toContain("the worker died: it ended with exit code 7;");
    expect(scripted.map(({ isEnded }) => isEnded)).toEqual([true, true]);
  });

  it("has the reason of an error that ended a worker", async () => {
    const cloud = await cloudIn(1);
    const cause = new RangeError("out of stack");
    scripted[0]!.emit("error", cause);
    expect(await problemOf(() => cloud.visibleFrom(farAway))).toMatchObject({ code: "internal", cause });
  });
});

describe("without the option `workers`", () => {
  const several = Math.min(availableParallelism(), 4);
  const sizes: [name: string, numbers: number, options: object, workers: number][] = [
    ["199,999 points", 3 * 199_999, {}, 1],
    ["200,000 points", 3 * 200_000, {}, several],
    ["200,000 points with 4 numbers each", 4 * 200_000, { stride: 4 }, several],
    ["200,000 points in a plane", 2 * 200_000, { dimension: 2 }, 1],
  ];
  it.each(sizes)("%s are in as many workers as they need", async (_, numbers, options, workers) => {
    const creating = WorkerPointCloud.create(new Float32Array(numbers), options);
    const cloud = await heldBy(workers, creating, 200_000);
    expect(scripted).toHaveLength(workers);
    await cloud.dispose();
  });
});

describe("a view", () => {
  it("is divided among the workers, who get their memory again", async () => {
    const cloud = await cloudIn(2);
    const view = async (parts: number[][]) => {
      const asked = cloud.visibleFrom(farAway);
      const sent = newest();
      scripted.forEach((worker, number) => {
        worker.answers(found(parts[number]!, 100));
      });
      return { sent, indices: [...(await asked).indices] };
    };
    const first = await view([
      [1, 31, 64, 99],
      [32, 63],
    ]);
    expect(first.indices).toEqual([1, 31, 32, 63, 64, 99]);
    for (const [number, request] of first.sent.entries()) {
      const own = { sector: { number, count: 2 }, spare: undefined, sliced: false };
      expect(request).toMatchObject({ kind: "visibleFrom", viewpoint: farAway, divisible: true, ...own });
    }
    expect((await view([[7], []])).indices).toEqual([7]);
    expect(scripted.map(({ moved }) => moved)).toEqual([
      [[points.byteLength], [], [16]],
      [[points.byteLength], [], [8]],
    ]);
    expect((await view([[], []])).indices).toEqual([]);
  });

  it("has its answer in the memory that was recycled", async () => {
    const cloud = await cloudIn(2);
    const ask = async (parts: number[][]) => {
      const asked = cloud.visibleFrom(farAway);
      scripted.forEach((worker, number) => {
        worker.answers(found(parts[number]!, 100));
      });
      return asked;
    };
    cloud.recycle(await ask([[1, 2, 3], [4]]));
    const next = await ask([[5], [6]]);
    expect([next.indices.buffer.byteLength, ...next.indices]).toEqual([16, 5, 6]);
  });

  it("of a camera has pixels and depths in the order of the indices", async () => {
    const cloud = await cloudIn(2);
    const cameraToWorld = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1];
    const size = { fx: 100, fy: 100, cx: 100, cy: 100, width: 200, height: 200 };
    const asked = cloud.visibleFromCamera({ cameraToWorld, convention: "opengl", ...size });
    const part = (indices: number[]) => ({
      ...found(indices, 100),
      pixels: Float32Array.from(indices.flatMap((index) => [index, index + 0.5])),
      depths: Float32Array.from(indices.map((index) => -index)),
    });
    scripted[0]!.answers(part([2, 9, 70]));
    scripted[1]!.answers(part([0, 3, 4]));
    const { indices, pixels, depths } = await asked;
    expect([...indices]).toEqual([0, 2, 3, 4, 9, 70]);
    expect([...pixels]).toEqual([0, 0.5, 2, 2.5, 3, 3.5, 4, 4.5, 9, 9.5, 70, 70.5]);
    expect([...depths]).toEqual([-0, -2, -3, -4, -9, -70]);
  });

  it("that no one can divide is asked of the first worker, with the memory that was recycled", async () => {
    const cloud = await cloudIn(2);
    const asked = cloud.visibleFromDirection([0, 0, 1]);
    expect(scripted.map(({ moved }) => moved.length)).toEqual([2, 1]);
    scripted[0]!.answers(found([5, 6], 100));
    cloud.recycle(await asked);
    const voted = cloud.visibleFrom(farAway, { vote: 3 });
    expect([scripted[0]!.moved.at(-1), scripted[1]!.moved.length]).toEqual([[8], 1]);
    expect(newest()[0]).toMatchObject({ divisible: false, sliced: false });
    scripted[0]!.answers(found([3], 100));
    expect([...(await voted).indices]).toEqual([3]);
    const radius = cloud.autoRadius(farAway);
    expect(Object.keys(newest()[0]!).sort()).toEqual(["kind", "module", "settings", "viewpoint"]);
    scripted[0]!.answers({ radius: 4, exponent: 0, evaluations: 0 });
    expect((await radius).radius).toBe(4);
  });

  it("goes on from its draft in the first of two workers; three start from nothing", async () => {
    for (const [workers, others] of [
      [2, 0],
      [3, 2],
    ] as const) {
      scripted.length = 0;
      const cloud = await cloudIn(workers);
      const askedBy = async (viewpoint: number[], options: object) => {
        const before = scripted.map(({ posted }) => posted.length);
        const asked = cloud.visibleFrom(viewpoint, options);
        const by = scripted.filter(({ posted }, number) => posted.length > before[number]!);
        for (const worker of by) worker.answers(found([], 100));
        await asked;
        return by.length;
      };
      expect(await askedBy(farAway, { draft: true })).toBe(1);
      expect(await askedBy(farAway, {})).toBe(1 + others);
      // The draft has been used, or belongs to another view.
      expect(await askedBy(farAway, {})).toBe(workers);
      await askedBy(farAway, { draft: true });
      expect(await askedBy([0, 0, 6], {})).toBe(workers);
      await askedBy(farAway, { draft: true });
      expect(await askedBy(farAway, { exponent: 3 })).toBe(workers);
    }
  });

  it("with a mask does not go on from a draft, nor does a view after a survey", async () => {
    const cloud = await cloudIn(2);
    const bothAsked = async (options: object) => {
      const asked = cloud.visibleFrom(farAway, options);
      for (const worker of scripted) worker.answers(found([], 100));
      await asked;
      return newest().every(({ sector }) => sector !== undefined);
    };
    const draft = async (options: object) => {
      const drafted = cloud.visibleFrom(farAway, { ...options, draft: true });
      scripted[0]!.answers(found([], 100));
      await drafted;
    };
    const within = { mask: new Uint8Array(100).fill(1) };
    await draft({ within });
    expect(await bothAsked({ within })).toBe(true);
    await draft({});
    await cloud.coverage([]);
    expect(await bothAsked({})).toBe(true);
  });

  it("that is given up is given up by the first worker, and the next request waits for its reply", async () => {
    const cloud = await cloudIn(2);
    const { signal, abort } = abortable();
    const given = problemOf(() => cloud.visibleFrom(farAway, { looks: 3, signal }));
    const next = cloud.autoRadius(farAway);
    expect(newest()[0]).toMatchObject({ kind: "visibleFrom", divisible: false, sliced: true });
    abort();
    expect(kindsSent()).toEqual([["create", "visibleFrom", "abandon"], ["create"]]);
    expect([newest()[0], scripted[0]!.moved.at(-1)]).toEqual([{ kind: "abandon" }, []]);
    expect((await given).name).toBe("AbortError");
    scripted[0]!.says({ abandoned: true });
    expect(newest()[0]).toMatchObject({ kind: "autoRadius" });
    scripted[0]!.answers({ radius: 4, exponent: 0, evaluations: 0 });
    expect((await next).radius).toBe(4);
  });

  it("that is divided is not computed in slices, also with a signal", async () => {
    const cloud = await cloudIn(2);
    const asked = cloud.visibleFrom(farAway, { signal: abortable().signal });
    for (const worker of scripted) {
      expect(worker.posted.at(-1)).toMatchObject({ sliced: false });
      worker.answers(found([], 100));
    }
    expect((await asked).count).toBe(0);
  });
});
