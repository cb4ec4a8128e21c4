import type threads from "node:worker_threads";
import { afterEach, beforeEach, describe, expect, it } from "vitest";

import { OriginalWorker, replaceWorker } from "./node-workers";
import { bumpySphere, problemOf, readyPackage } from "./support";

const { WorkerPointCloud, PointCloud } = await readyPackage();

const sphere = bumpySphere(1, 3000);
const farAway = [0, 0, 5];
const started: threads.Worker[] = [];

class ListedWorker extends OriginalWorker {
  constructor(...args: ConstructorParameters<typeof OriginalWorker>) {
    super(...args);
    started.push(this);
  }
}

beforeEach(() => {
  replaceWorker(ListedWorker);
});

afterEach(async () => {
  replaceWorker(OriginalWorker);
  await Promise.all(started.splice(0).map((worker) => worker.terminate()));
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
