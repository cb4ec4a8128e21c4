// A survey: which worker gets which view, and what becomes of refusals.
import { afterEach, beforeEach, expect, it } from "vitest";

import { found, heldBy, scripted, useOwnWorkers, useScriptedWorkers } from "./scripted-workers";
import { bumpySphere, problemOf, readyPackage } from "./support";

const { WorkerPointCloud } = await readyPackage();

const points = bumpySphere(1, 100);
const places = [1, 2, 3].map((z) => [0, 0, z]);

beforeEach(useScriptedWorkers);
afterEach(useOwnWorkers);

const cloudInTwo = () => heldBy(2, WorkerPointCloud.create(points, { workers: 2 }), 100);
/** Where the views of each worker stand. The first request is the cloud itself. */
const views = () => scripted.map(({ posted }) => posted.slice(1).map(({ viewpoint }) => (viewpoint as number[])[2]));
const dealt = () => new Promise((resolve) => setImmediate(resolve));

it("every worker has one view at a time", async () => {
  const cloud = await cloudInTwo();
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
  const cloud = await cloudInTwo();
  expect(await cloud.coverage([])).toEqual(new Uint32Array(100));
  expect(views()).toEqual([[], []]);
});

it("of several refusals, the one of the first viewpoint counts, and nothing more is asked", async () => {
  const cloud = await cloudInTwo();
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
  const cloud = await cloudInTwo();
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
  const cloud = await cloudInTwo();
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
  const cloud = await cloudInTwo();
  const asked = problemOf(() => cloud.coverage(places));
  await dealt();
  scripted[0]!.refuses("internal", "first");
  scripted[1]!.refuses("internal", "second");
  expect((await asked).message).toBe("first");
});

it("nothing more is asked after an answer that cannot be taken", async () => {
  const cloud = await cloudInTwo();
  const asked = problemOf(() => cloud.placeViewpoints(places, { weights: [1, 2, 3] }));
  await dealt();
  scripted[0]!.answers(found([1], 100));
  scripted[1]!.answers(found([2], 100));
  expect((await asked).code).toBe("option");
  expect(views()).toEqual([[2], [1]]);
});

it("nothing more is asked after an abort", async () => {
  const cloud = await cloudInTwo();
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
  const cloud = await cloudInTwo();
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
