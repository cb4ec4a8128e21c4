// Many clouds in one worker.
import { expect, it } from "vitest";

import { running, watchedWorkers } from "./node-workers";
import { bumpySphere, freshPackage, problemOf, readyPackage } from "./support";
import { trappingWasm } from "./trapping-wasm";

const { WorkerPointCloud, PointCloud } = await readyPackage();

const farAway = [0, 0, 5];
const started = watchedWorkers();

it("each cloud answers as if it were alone, and the worker ends with the last", async () => {
  const spheres = [1, 2, 3, 4, 5, 6].map((seed) => bumpySphere(seed, 500 * seed));
  const clouds = await Promise.all(spheres.map((positions) => WorkerPointCloud.create(positions, { shared: true })));
  expect(started).toHaveLength(1);
  const expected = spheres.map((positions) => new PointCloud(positions).visibleFrom(farAway));
  expect(await Promise.all(clouds.map((cloud) => cloud.visibleFrom(farAway)))).toEqual(expected);

  await Promise.all(clouds.slice(1).map((cloud) => cloud.dispose()));
  expect(running.size).toBe(1);
  expect((await problemOf(() => clouds[1]!.visibleFrom(farAway))).code).toBe("disposed");
  expect(await clouds[0]!.visibleFrom(farAway)).toEqual(expected[0]);
  const late = await WorkerPointCloud.create(spheres[1]!, { shared: true });
  expect(await late.visibleFrom(farAway)).toEqual(expected[1]);
  expect(started).toHaveLength(1);

  await Promise.all([late.dispose(), clouds[0]!.dispose(), clouds[0]!.dispose()]);
  expect(running.size).toBe(0);
  const anew = await WorkerPointCloud.create(spheres[2]!, { shared: true });
  expect(await anew.visibleFrom(farAway)).toEqual(expected[2]);
  expect(started).toHaveLength(2);
  await anew.dispose();
});

it.each([1, 2, 5, 20])("views in slices of %i clouds end, in turn, also while another cloud is asked", async (many) => {
  const spheres = Array.from({ length: many + 1 }, (_, seed) => bumpySphere(seed, 4000));
  const clouds = await Promise.all(spheres.map((positions) => WorkerPointCloud.create(positions, { shared: true })));
  const [moving, ...resting] = clouds;
  // A view with a signal is computed in slices.
  const { signal } = new AbortController();
  const order: number[] = [];
  const looks = resting.map(async (cloud, number) => {
    const seen = await cloud.visibleFrom(farAway, { looks: 3, signal });
    order.push(number);
    return seen;
  });
  let turns = 0;
  while (order.length < many) {
    await moving!.visibilityMap([0, turns++ / 100, 5]);
  }
  expect(await Promise.all(looks)).toEqual(
    spheres.slice(1).map((positions) => new PointCloud(positions).visibleFrom(farAway, { looks: 3 })),
  );
  expect(order).toEqual(looks.map((_, number) => number));
  // A view has some 5 slices. A view that began again after each of them would have as many as there are maps.
  expect(turns).toBeLessThan(12 * many + 12);
  await Promise.all(clouds.map((cloud) => cloud.dispose()));
});

it("a view in slices that waits for its turn can be given up", async () => {
  const clouds = await Promise.all(
    [1, 2, 3].map((seed) => WorkerPointCloud.create(bumpySphere(seed, 4000), { shared: true })),
  );
  const controls = clouds.map(() => new AbortController());
  const asked = clouds.map((cloud, number) =>
    cloud
      .visibleFrom(farAway, { looks: 3, signal: controls[number]!.signal })
      .catch((error: unknown) => (error as Error).name),
  );
  await Promise.resolve();
  controls[1]!.abort();
  controls[0]!.abort();
  expect(await Promise.all(asked)).toEqual(["AbortError", "AbortError", expect.objectContaining({ exact: true })]);
  // Each cloud got the reply that it waited for.
  for (const cloud of clouds) expect((await cloud.visibleFrom(farAway)).count).toBeGreaterThan(100);
  await Promise.all(clouds.map((cloud) => cloud.dispose()));
});

it("all clouds of a dead worker are lost, and the next cloud gets a new worker", async () => {
  const [first, second] = await Promise.all(
    [1, 2].map((seed) => WorkerPointCloud.create(bumpySphere(seed, 900), { shared: true })),
  );
  const [worker] = running;
  // No answer comes before the death, however fast the worker is.
  worker!.removeAllListeners("message");
  const pending = problemOf(() => first!.visibleFrom(farAway));
  await worker!.terminate();
  expect((await pending).code).toBe("internal");
  expect((await problemOf(() => second!.visibleFrom(farAway))).code).toBe("internal");
  const next = await WorkerPointCloud.create(bumpySphere(1, 900), { shared: true });
  expect((await next.visibleFrom(farAway)).count).toBeGreaterThan(100);
  await Promise.all([first, second, next].map((cloud) => cloud!.dispose()));
  expect(running.size).toBe(0);
});

it("after a trap the worker goes on with new clouds", async () => {
  const fresh = await freshPackage();
  await fresh.init(trappingWasm("autoRadius"));
  const create = () => fresh.WorkerPointCloud.create(bumpySphere(1, 900), { shared: true });
  const [one, other] = await Promise.all([create(), create()]);
  expect((await problemOf(() => one.autoRadius(farAway))).code).toBe("internal");
  expect((await problemOf(() => other.visibleFrom(farAway))).code).toBe("internal");
  const next = await create();
  expect((await next.visibleFrom(farAway)).count).toBeGreaterThan(100);
  await next.dispose();
});

it("a cloud that is refused or given up does not affect the others", async () => {
  const stays = await WorkerPointCloud.create(bumpySphere(1, 900), { shared: true });
  expect((await problemOf(() => WorkerPointCloud.create([1, 2, NaN], { shared: true }))).code).toBe("non-finite");
  const control = new AbortController();
  const given = problemOf(() => WorkerPointCloud.create(bumpySphere(2, 900), { shared: true, signal: control.signal }));
  control.abort();
  expect((await given).name).toBe("AbortError");
  expect((await stays.visibleFrom(farAway)).count).toBeGreaterThan(100);
  expect(started).toHaveLength(1);
  await stays.dispose();
  expect(running.size).toBe(0);
});

it("cannot be combined with a number of workers", async () => {
  const problem = await problemOf(() => WorkerPointCloud.create([0, 0, 1], { shared: true, workers: 1 }));
  expect(problem).toMatchObject({ code: "option", message: expect.stringContaining("shared and workers") as string });
});
