// What a cloud asks of its workers, and what it makes of their answers and deaths.
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
    scripted[0]!.answers(found([], 100));
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

it("is in one worker without the option `workers`", async () => {
  const cloud = await heldBy(1, WorkerPointCloud.create(new Float32Array(3 * 200_000)), 200_000);
  expect(scripted).toHaveLength(1);
  await cloud.dispose();
});

describe("a view", () => {
  it("is asked of the first worker alone", async () => {
    const cloud = await cloudIn(2);
    const asked = cloud.visibleFrom(farAway);
    expect(newest()[0]).toMatchObject({ kind: "visibleFrom", viewpoint: farAway, sliced: false });
    expect(kindsSent()[1]).toEqual(["create"]);
    scripted[0]!.answers(found([5, 6], 100));
    expect([...(await asked).indices]).toEqual([5, 6]);
    const radius = cloud.autoRadius(farAway);
    expect(Object.keys(newest()[0]!).sort()).toEqual(["kind", "module", "settings", "viewpoint"]);
    scripted[0]!.answers({ radius: 4, exponent: 0, evaluations: 0 });
    expect((await radius).radius).toBe(4);
  });

  it("that is given up is given up by the first worker, and the next request waits for its reply", async () => {
    const cloud = await cloudIn(2);
    const { signal, abort } = abortable();
    const given = problemOf(() => cloud.visibleFrom(farAway, { looks: 3, signal }));
    const next = cloud.autoRadius(farAway);
    expect(newest()[0]).toMatchObject({ kind: "visibleFrom", sliced: true });
    abort();
    expect(kindsSent()).toEqual([["create", "visibleFrom", "abandon"], ["create"]]);
    expect([newest()[0], scripted[0]!.moved.at(-1)]).toEqual([{ kind: "abandon" }, []]);
    expect((await given).name).toBe("AbortError");
    scripted[0]!.says({ abandoned: true });
    expect(newest()[0]).toMatchObject({ kind: "autoRadius" });
    scripted[0]!.answers({ radius: 4, exponent: 0, evaluations: 0 });
    expect((await next).radius).toBe(4);
  });
});
