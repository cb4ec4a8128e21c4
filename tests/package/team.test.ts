// What a cloud asks of its workers, which of them gets which view of a survey, and what it makes of their refusals and deaths.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { found, heldBy, scripted, until, useOwnWorkers, useScriptedWorkers } from "./scripted-workers";
import { bumpySphere, problemOf, readyPackage } from "./support";

const { WorkerPointCloud } = await readyPackage();

const points = bumpySphere(1, 100);
const farAway = [0, 0, 5];

beforeEach(useScriptedWorkers);
afterEach(() => {
  vi.restoreAllMocks();
  useOwnWorkers();
});

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

/** The cloud goes on: each worker answers the next view. */
async function expectAnswer(cloud: Awaited<ReturnType<typeof cloudIn>>) {
  const view = cloud.visibleFrom(farAway);
  scripted[0]!.answers(found([], 100));
  expect((await view).count).toBe(0);
}

describe("a change", () => {
  it.each(["append", "remove"] as const)("by %s is for all workers; who has no memory for it leaves", async (kind) => {
    const cloud = await cloudIn(3);
    const change = kind === "append" ? cloud.append(points) : cloud.remove([1, 2]);
    const numbers = kind === "append" ? points : Uint32Array.of(1, 2);
    const sent = kind === "append" ? { positions: numbers } : { indices: numbers };
    for (const { posted, moved } of scripted) {
      expect(posted.at(-1)).toEqual({ kind, module: undefined, ...sent });
      expect(moved.at(-1)).toEqual([numbers.byteLength]);
    }
    const size = { length: 200, skipped: 0, spacing: 1 };
    scripted[0]!.answers(size);
    scripted[1]!.refuses("too-large", "no memory");
    expect(cloud.length).toBe(100);
    scripted[2]!.answers(size);
    await change;
    expect(cloud.length).toBe(200);
    expect(scripted.map(({ isEnded }) => isEnded)).toEqual([false, true, false]);
    // The views of a survey are for those who are left.
    const asked = cloud.coverage([farAway, farAway]);
    await new Promise((resolve) => setImmediate(resolve));
    expect(newest().map((request) => request.kind)).toEqual(["visibleFrom", kind, "visibleFrom"]);
    scripted[0]!.answers(found([130], 200));
    scripted[2]!.answers(found([2], 200));
    expect((await asked).filter((count) => count > 0)).toHaveLength(2);
  });

  it.each(["append", "remove"] as const)(
    "by %s is refused if all workers refuse it, and nobody leaves",
    async (kind) => {
      const cloud = await cloudIn(2);
      const change = kind === "append" ? cloud.append(points) : cloud.remove([100]);
      scripted[1]!.refuses("option", "second");
      scripted[0]!.refuses("option", "first");
      expect(await problemOf(() => change)).toMatchObject({ code: "option", message: "first" });
      expect(scripted.map(({ isEnded }) => isEnded)).toEqual([false, false]);
      await expectAnswer(cloud);
    },
  );

  it.each(["append", "remove"] as const)("by %s that loses a worker ends the cloud", async (kind) => {
    const cloud = await cloudIn(2);
    const change = kind === "append" ? cloud.append(points) : cloud.remove([1]);
    scripted[0]!.answers({ length: 200, skipped: 0, spacing: 1 });
    scripted[1]!.refuses("internal", "a trap");
    expect(await problemOf(() => change)).toMatchObject({ code: "internal", message: "a trap" });
    expect(scripted.map(({ isEnded }) => isEnded)).toEqual([true, true]);
  });

  it("is asked of nobody if there is no memory for the copies", async () => {
    const cloud = await cloudIn(2);
    const copy = vi.spyOn(Uint32Array.prototype, "slice").mockImplementation(() => {
      throw new RangeError("Array buffer allocation failed");
    });
    const change = problemOf(() => cloud.remove([1]));
    expect(copy).toHaveBeenCalled();
    copy.mockRestore();
    expect(await change).toMatchObject({ code: "too-large" });
    expect(newest().map(({ kind }) => kind)).toEqual(["create", "create"]);
    await expectAnswer(cloud);
  });
});

const places = [1, 2, 3].map((z) => [0, 0, z]);

/** Where the views of each worker stand. The first request is the cloud itself. */
const views = () => scripted.map(({ posted }) => posted.slice(1).map(({ viewpoint }) => (viewpoint as number[])[2]));
const dealt = () => new Promise((resolve) => setImmediate(resolve));

it("every worker has one view at a time", async () => {
  const cloud = await cloudIn(2);
  const asked = cloud.coverage(places);
  const later = cloud.autoRadius(places[0]!);
  await dealt();
  expect(views()).toEqual([[2], [1]]);
  scripted[0]!.answers(found([1, 2, 3], 100));
  expect(views()).toEqual([[2, 3], [1]]);
  expect(scripted[0]!.posted.at(-1)).toMatchObject({ kind: "visibleFrom" });
  scripted[1]!.answers(found([2], 100));
  expect(views()).toEqual([[2, 3], [1]]);
  scripted[0]!.answers(found([2, 3], 100));
  expect([...(await asked).subarray(0, 5)]).toEqual([0, 1, 3, 2, 0]);
  // Only now is it the turn of the next request.
  scripted[0]!.answers({ radius: 4, exponent: 0, evaluations: 0 });
  expect((await later).radius).toBe(4);
});

it("no worker is asked about no viewpoints", async () => {
  const cloud = await cloudIn(2);
  expect(await cloud.coverage([])).toEqual(new Uint32Array(100));
  expect(views()).toEqual([[], []]);
});

it("of several refusals, the one of the first viewpoint counts, and nothing more is asked", async () => {
  const cloud = await cloudIn(2);
  for (const order of [
    [0, 1],
    [1, 0],
  ]) {
    const before = views();
    const asked = problemOf(() => cloud.coverage(places));
    await dealt();
    // The second worker has the first viewpoint.
    for (const number of order) scripted[number]!.refuses("radius", `viewpoint ${1 - number}`);
    expect(await asked).toMatchObject({ code: "radius", message: "viewpoint 0" });
    expect(views()).toEqual([
      [...before[0]!, 2],
      [...before[1]!, 1],
    ]);
  }
});

it("a refusal is not told before all views have ended", async () => {
  const cloud = await cloudIn(2);
  const asked = problemOf(() => cloud.coverage(places));
  const later = cloud.autoRadius(places[0]!);
  await dealt();
  scripted[1]!.refuses("radius", "too small");
  expect(scripted[1]!.posted).toHaveLength(2);
  scripted[0]!.answers(found([1], 100));
  expect((await asked).message).toBe("too small");
  scripted[0]!.answers({ radius: 4, exponent: 0, evaluations: 0 });
  expect((await later).radius).toBe(4);
});

it.each([
  ["before", [1, 0]],
  ["after", [0, 1]],
])("a worker that is lost %s another refusal ends the cloud", async (_, order) => {
  const cloud = await cloudIn(2);
  const asked = problemOf(() => cloud.coverage(places));
  await dealt();
  for (const number of order) {
    // The other worker has the first viewpoint.
    if (number === 0) scripted[0]!.refuses("internal", "a trap");
    else scripted[1]!.refuses("radius", "too small");
  }
  expect(await asked).toMatchObject({ code: "internal", message: "a trap" });
  expect(scripted.map(({ isEnded }) => isEnded)).toEqual([true, true]);
});

it("of two workers that are lost, the first is named", async () => {
  const cloud = await cloudIn(2);
  const asked = problemOf(() => cloud.coverage(places));
  await dealt();
  scripted[0]!.refuses("internal", "first");
  scripted[1]!.refuses("internal", "second");
  expect((await asked).message).toBe("first");
});

it("nothing more is asked after an answer that cannot be taken", async () => {
  const cloud = await cloudIn(2);
  const asked = problemOf(() => cloud.placeViewpoints(places, { weights: [1, 2, 3] }));
  await dealt();
  scripted[0]!.answers(found([1], 100));
  scripted[1]!.answers(found([2], 100));
  expect((await asked).code).toBe("option");
  expect(views()).toEqual([[2], [1]]);
});

it("nothing more is asked after an abort", async () => {
  const cloud = await cloudIn(2);
  const controller = new AbortController();
  const asked = problemOf(() => cloud.coverage(places, { signal: controller.signal }));
  await dealt();
  controller.abort();
  expect((await asked).name).toBe("AbortError");
  const later = cloud.autoRadius(places[0]!);
  scripted[0]!.answers(found([1], 100));
  scripted[1]!.answers(found([1], 100));
  expect(scripted.map(({ posted }) => posted.map(({ kind }) => kind).filter((kind) => kind === "visibleFrom"))).toEqual(
    [["visibleFrom"], ["visibleFrom"]],
  );
  scripted[0]!.answers({ radius: 4, exponent: 0, evaluations: 0 });
  expect((await later).radius).toBe(4);
});

it("a survey that waits is overtaken by a newer one with `latest`, and tells its progress", async () => {
  const cloud = await cloudIn(2);
  const running = cloud.autoRadius(places[0]!);
  const told: number[] = [];
  const overtaken = problemOf(() => cloud.coverage(places, { latest: true }));
  const asked = cloud.coverage([[0, 0, 7]], { latest: true, onProgress: (share) => told.push(share) });
  expect((await overtaken).name).toBe("AbortError");
  scripted[0]!.answers({ radius: 4, exponent: 0, evaluations: 0 });
  await running;
  await dealt();
  expect(scripted.map(({ posted }) => posted.at(-1)!["viewpoint"])).toEqual([
    [0, 0, 1],
    [0, 0, 7],
  ]);
  scripted[1]!.answers(found([1], 100));
  expect((await asked)[1]).toBe(1);
  expect(told).toEqual([1]);
});
