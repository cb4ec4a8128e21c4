// Workers that compute for long, and workers that die without a word.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

import { CountedWorker, replaceWorker, running, workersAfter } from "./node-workers";
import { found, heldBy, scripted, until, useOwnWorkers, useScriptedWorkers } from "./scripted-workers";
import { bumpySphere, problemOf, readyPackage } from "./support";

const { WorkerPointCloud, PointCloud } = await readyPackage();

const points = bumpySphere(1, 100);
const farAway = [0, 0, 5];
const size = { length: 100, skipped: 0, spacing: 1 };

beforeEach(() => {
  vi.useFakeTimers({ toFake: ["setInterval", "clearInterval"] });
});

afterEach(() => {
  vi.useRealTimers();
  useOwnWorkers();
});

const seconds = (count: number) => vi.advanceTimersByTime(1000 * count);
const kinds = (number: number) => scripted[number]!.posted.map(({ kind }) => kind);
const all = [
  ["one worker", {}, 1],
  ["two workers", { workers: 2 }, 2],
  ["the shared worker", { shared: true }, 1],
] as const;

describe.each(all)("with %s", (_, options, count) => {
  beforeEach(useScriptedWorkers);

  const create = () => heldBy(count, WorkerPointCloud.create(points, options), 100);
  /** The workers that came instead of the first ones. */
  const later = () => scripted.slice(count);
  const restarted = async () => {
    await until(() => later().length === count);
    for (const worker of later()) worker.isReady();
    await until(() => later().every(({ posted }) => posted.length === 1));
  };

  it("a question of 60 s is answered, if its worker says that it is alive", async () => {
    const cloud = await create();
    const asked = cloud.visibleFrom(farAway);
    for (let second = 0; second < 60; second++) {
      seconds(1);
      for (const worker of scripted) worker.emit("message", "beat");
    }
    scripted[0]!.answers(found([3], 100));
    expect((await asked).count).toBe(1);
    expect(scripted).toHaveLength(count);
    await cloud.dispose();
  });

  it("a silent worker is replaced once, and asked the same again", async () => {
    const cloud = await create();
    const changes = [cloud.append(points), cloud.remove([7])];
    for (let change = 0; change < 2; change++) for (const worker of scripted) worker.answers(size);
    await Promise.all(changes);
    const asked = cloud.visibleFrom(farAway);
    const waiting = cloud.autoRadius(farAway);
    seconds(19);
    expect(scripted).toHaveLength(count);
    seconds(1);
    await restarted();
    expect(scripted.map(({ isEnded }) => isEnded)).toEqual(scripted.map((_, number) => number < count));
    for (const kind of ["create", "append", "remove"]) {
      for (const worker of later()) {
        expect(worker.posted.at(-1)!.kind).toBe(kind);
        worker.answers(size);
      }
    }
    expect(later()[0]!.posted[0]!["positions"]).toEqual(points);
    later()[0]!.answers(found([3], 100));
    expect((await asked).count).toBe(1);
    expect(kinds(count).at(-1)).toBe("autoRadius");
    later()[0]!.answers({ radius: 3, exponent: 1, evaluations: 1 });
    expect((await waiting).radius).toBe(3);
    await cloud.dispose();
  });

  it("the error is `internal` if its successor is silent, too", async () => {
    const cloud = await create();
    const problem = problemOf(() => cloud.visibleFrom(farAway));
    seconds(20);
    await restarted();
    seconds(20);
    expect(await problem).toMatchObject({ code: "internal", cause: { name: "TimeoutError" } });
    expect(scripted.every(({ isEnded }) => isEnded)).toBe(true);
    expect((await problemOf(() => cloud.autoRadius(farAway))).code).toBe("internal");
  });

  it("no sign of life is expected of a worker that owes nothing", async () => {
    const cloud = await create();
    seconds(100);
    expect(scripted).toHaveLength(count);
    await cloud.dispose();
  });
});

describe("a silent worker", () => {
  beforeEach(useScriptedWorkers);

  it("is not replaced if the positions were given away", async () => {
    const creating = WorkerPointCloud.create(points.slice(), { transfer: true });
    const cloud = await heldBy(1, creating, 100);
    const problem = problemOf(() => cloud.visibleFrom(farAway));
    seconds(20);
    expect((await problem).code).toBe("internal");
    expect(scripted).toHaveLength(1);
  });

  it("may be building the cloud, or answering many views", async () => {
    const creating = WorkerPointCloud.create(points);
    await until(() => scripted.length === 1);
    scripted[0]!.isReady();
    await until(() => kinds(0).length === 1);
    seconds(20);
    await until(() => scripted.length === 2);
    scripted[1]!.isReady();
    await until(() => kinds(1).length === 1);
    scripted[1]!.answers(size);
    const cloud = await creating;
    const coverage = cloud.coverage([farAway, farAway, farAway]);
    await until(() => kinds(1).length === 2);
    scripted[1]!.answers(found([1], 100));
    seconds(20);
    await until(() => scripted.length === 3);
    scripted[2]!.isReady();
    await until(() => kinds(2).length === 1);
    scripted[2]!.answers(size);
    for (const view of [2, 3]) {
      await until(() => kinds(2).length === view);
      scripted[2]!.answers(found([1], 100));
    }
    expect((await coverage)[1]).toBe(3);
    await cloud.dispose();
  });
});

describe("a thread", () => {
  const sphere = bumpySphere(2, 20_000);
  it("says in the middle of a computation that it is alive", async () => {
    replaceWorker(workersAfter("let time = 0; performance.now = () => (time += 500)"));
    const cloud = await WorkerPointCloud.create(sphere);
    let beats = 0;
    for (const worker of running) worker.on("message", (message) => (beats += message === "beat" ? 1 : 0));
    expect(await cloud.visibleFrom(farAway)).toEqual(new PointCloud(sphere).visibleFrom(farAway));
    expect(beats).toBeGreaterThan(2);
    await cloud.dispose();
  });

  it("that never ends its computation is replaced, and the answer comes all the same", async () => {
    const hangs = `require("node:worker_threads").parentPort.on("message", ({ content }) => {
      while (content.kind === "visibleFrom");
    })`;
    replaceWorker(workersAfter(hangs));
    const cloud = await WorkerPointCloud.create(sphere);
    replaceWorker(CountedWorker);
    const asked = cloud.visibleFrom(farAway);
    seconds(20);
    expect(await asked).toEqual(new PointCloud(sphere).visibleFrom(farAway));
    await cloud.dispose();
    await until(() => running.size === 0);
  });
});
