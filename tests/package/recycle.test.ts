// Memory of answers that is given back for later answers. Nothing else may ever change.
import type threads from "node:worker_threads";
import { afterEach, beforeEach, describe, expect, it } from "vitest";

import { OriginalWorker, replaceWorker } from "./node-workers";
import { drawnOf, nodeOf } from "./nodes-support";
import { bumpySphere, problemOf, randomNumbers, readyPackage } from "./support";
import { adapterFor, drawn, nextChange, sceneOf, VERSIONS } from "./three-support";

const { WorkerPointCloud, PointCloud, HprError } = await readyPackage();

type Cloud = InstanceType<typeof PointCloud>;
type WorkerCloud = Awaited<ReturnType<typeof WorkerPointCloud.create>>;
type Answer = ReturnType<Cloud["visibleFrom"]>;
type Reconstruction = ReturnType<Cloud["reconstruct"]>;

const sphere = bumpySphere(1, 3000);
const direct = new PointCloud(sphere);
/** More is visible from farther away. */
const [near, farAway] = [
  [0, 0, 1.5],
  [0, 0, 5],
];
const loose = (value: unknown) => value as never;

const started: threads.Worker[] = [];
/** The bytes that were sent with each request for a view. */
const given: number[] = [];

beforeEach(() => {
  replaceWorker(
    class extends OriginalWorker {
      constructor(...args: ConstructorParameters<typeof OriginalWorker>) {
        super(...args);
        started.push(this);
      }

      override postMessage(...[message, transfer]: Parameters<threads.Worker["postMessage"]>): void {
        const { kind, spare } = (message as { content: { kind: string; spare?: ArrayBuffer } }).content;
        if (kind === "visibleFrom") given.push(spare?.byteLength ?? 0);
        super.postMessage(message, transfer);
      }
    },
  );
});

afterEach(async () => {
  replaceWorker(OriginalWorker);
  given.length = 0;
  await Promise.all(started.splice(0).map((worker) => worker.terminate()));
});

describe.each<[string, () => Promise<Cloud | WorkerCloud>]>([
  ["a cloud", () => Promise.resolve(new PointCloud(sphere))],
  ["a cloud in a worker", () => WorkerPointCloud.create(sphere)],
  ["a cloud in three workers", () => WorkerPointCloud.create(sphere, { workers: 3 })],
])("an answer of %s that is recycled", (_, create) => {
  it("is empty, and the next answer gets its memory", async () => {
    const cloud = await create();
    const answer = await cloud.visibleFrom(farAway);
    const { byteLength } = answer.indices;
    expect(answer.indices.buffer.byteLength).toBe(byteLength);
    cloud.recycle(answer);
    expect(answer.indices).toHaveLength(0);
    for (const use of [() => answer.mask(), () => answer.indicesInto(new Uint32Array(3000))]) {
      expect((await problemOf(use)).code).toBe("disposed");
    }
    const next = await cloud.visibleFrom(near);
    expect(next).toEqual(direct.visibleFrom(near));
    expect(next.mask()).toEqual(direct.visibleFrom(near).mask());
    expect(next.indices.byteLength).toBeLessThan(byteLength);
    expect(next.indices.buffer.byteLength).toBe(byteLength);
    // Memory that was not given back is not used by any other answer.
    const last = await cloud.visibleFrom(farAway);
    expect(last.indices.buffer.byteLength).toBe(byteLength);
    expect(next).toEqual(direct.visibleFrom(near));
  });

  it("gives enough memory for a longer answer, with some to spare", async () => {
    const cloud = await create();
    cloud.recycle(await cloud.visibleFrom(near));
    const longer = await cloud.visibleFrom(farAway);
    expect(longer).toEqual(direct.visibleFrom(farAway));
    expect(longer.indices.buffer.byteLength).toBeGreaterThan(longer.indices.byteLength);
    expect(longer.indices.buffer.byteLength).toBeLessThanOrEqual(1.125 * longer.indices.byteLength);
  });

  it("may be recycled twice, in another cloud, or after dispose()", async () => {
    const [cloud, other] = [await create(), await create()];
    const answer = await cloud.visibleFrom(farAway);
    other.recycle(answer);
    other.recycle(answer);
    cloud.recycle(answer);
    const [first, second] = [await cloud.visibleFrom(farAway), await other.visibleFrom(farAway)];
    expect([first, second]).toEqual([direct.visibleFrom(farAway), direct.visibleFrom(farAway)]);
    await cloud.dispose();
    cloud.recycle(first);
    expect(first.indices).toHaveLength(0);
    expect(second).toEqual(direct.visibleFrom(farAway));
    const foreign = direct.visibleFrom(near);
    other.recycle(foreign);
    expect(foreign.indices).toHaveLength(0);
  });

  it("keeps its triangles", async () => {
    const cloud = await create();
    const expected = direct.reconstruct(farAway);
    const meshes: Reconstruction[] = [];
    for (let i = 0; i < 3; i++) {
      meshes.push(await cloud.reconstruct(farAway));
      cloud.recycle(meshes.at(-1)!);
      cloud.recycle(await cloud.visibleFrom(near));
    }
    for (const { triangles } of meshes) expect(triangles).toEqual(expected.triangles);
  });

  it("is refused if it is no answer", async () => {
    const cloud = await create();
    for (const value of [undefined, null, 1, {}, sphere, { indices: new Uint32Array(3) }]) {
      const problem = await problemOf(() => cloud.recycle(loose(value)));
      expect(problem).toBeInstanceOf(HprError);
      expect([problem.code, problem.message]).toEqual(["option", expect.stringContaining("recycle")]);
    }
    expect(await cloud.visibleFrom(farAway)).toEqual(direct.visibleFrom(farAway));
  });
});

it("an answer whose memory was transferred away has no memory to give", () => {
  const cloud = new PointCloud(sphere);
  const answer = cloud.visibleFrom(farAway);
  const mine = structuredClone(answer.indices, { transfer: [answer.indices.buffer as ArrayBuffer] });
  cloud.recycle(answer);
  expect(cloud.visibleFrom(near)).toEqual(direct.visibleFrom(near));
  expect(mine).toEqual(direct.visibleFrom(farAway).indices);
});

it("an empty answer has no memory to give, either", () => {
  const empty = new PointCloud([]);
  empty.recycle(empty.visibleFrom(farAway));
  expect(empty.visibleFrom(farAway).count).toBe(0);
});

/** All actions that may come between an answer and the next use of its memory, in any order. */
it.each([
  [1, 1],
  [2, 1],
  [3, 3],
  [4, 3],
])("kept answers never change, whatever happens to others (order %d, %d workers)", async (seed, workers) => {
  const random = randomNumbers(seed);
  const pick = (count: number) => Math.floor(random() * count);
  const clouds = [
    await WorkerPointCloud.create(sphere, { workers }),
    await WorkerPointCloud.create(sphere, { shared: true }),
  ];
  const places = Array.from({ length: 12 }, (_, i) => [Math.sin(i), Math.cos(2 * i), 1.5 + i / 4]);
  const expected = new Map(places.map((place) => [place, direct.visibleFrom(place).indices]));
  const kept: { answer: Answer; place: number[] }[] = [];
  const isWhole = ({ answer, place }: (typeof kept)[0]) => {
    const indices = expected.get(place)!;
    return answer.indices.length === indices.length && answer.indices.every((index, i) => index === indices[i]);
  };
  const pending = new Set<Promise<unknown>>();
  // Chosen before: how many numbers are drawn below depends on how fast answers come.
  const isGivenUp = Array.from({ length: 200 }, () => random() < 0.25);
  let [answered, aborted] = [0, 0];
  for (const giveUp of isGivenUp) {
    const cloud = clouds[pick(2)]!;
    const place = places[pick(places.length)]!;
    const controller = new AbortController();
    const options = { latest: random() < 0.3, signal: controller.signal };
    const asked = random() < 0.8 ? cloud.visibleFrom(place, options) : cloud.visibleFromAny([place], options);
    const settled = asked.then(
      (answer) => {
        answered += 1;
        kept.push({ answer, place });
      },
      () => {
        aborted += 1;
      },
    );
    pending.add(settled);
    void settled.finally(() => pending.delete(settled));
    if (giveUp) controller.abort();
    while (kept.length > 6 || (kept.length > 0 && random() < 0.4)) {
      clouds[pick(2)]!.recycle(kept.splice(pick(kept.length), 1)[0]!.answer);
    }
    if (random() < 0.3) await Promise.race(pending);
    expect(kept.every(isWhole)).toBe(true);
  }
  await Promise.all(pending);
  expect(kept.every(isWhole)).toBe(true);
  expect(answered + aborted).toBe(200);
  expect(Math.min(answered, aborted)).toBeGreaterThan(30);
});

it("no later answer needs the memory that is lost with a dead worker", async () => {
  const cloud = await WorkerPointCloud.create(sphere);
  const kept = await cloud.visibleFrom(near);
  cloud.recycle(await cloud.visibleFrom(farAway));
  started[0]!.removeAllListeners("message");
  const asked = problemOf(() => cloud.visibleFrom(farAway));
  void started[0]!.terminate();
  expect((await asked).code).toBe("internal");
  cloud.recycle(kept);
  expect(kept.indices).toHaveLength(0);
  const next = await WorkerPointCloud.create(sphere);
  next.recycle(kept);
  expect(await next.visibleFrom(farAway)).toEqual(direct.visibleFrom(farAway));
});

describe("an answer that is drawn goes back with the next request", () => {
  const places = [
    [0, 0, 5],
    [0, 0.1, 5],
    [0, 0.2, 5],
    [0, 0.3, 5],
  ];

  it.each([
    ["of a filter", "hide", false],
    ["of a filter that dims", "dim", false],
    ["of a filter that dims, with an index of the user's own", "dim", true],
  ] as const)("%s", async (_, mode, indexed) => {
    const adapter = await adapterFor(VERSIONS[0]![1]);
    const { points, camera, geometry } = sceneOf(adapter, sphere);
    const own = Array.from({ length: 3000 }, (_, i) => (indexed ? 2999 - i : i));
    if (indexed) geometry.setIndex(own);
    const filter = new adapter.HiddenPointFilter(points, { exponent: 3, mode });
    for (const place of places) {
      camera.position.fromArray(place);
      const change = nextChange(filter);
      filter.update(camera);
      await change;
      const visible = new Set(direct.visibleFrom(place, { exponent: 3 }).indices);
      expect(drawn(geometry)).toEqual(own.filter((i) => visible.has(i)));
      const dimmed = points.children.map((child) => drawn((child as typeof points).geometry));
      expect(dimmed).toEqual(mode === "dim" ? [own.filter((i) => !visible.has(i))] : []);
    }
    filter.dispose();
    expect([given[0], given.slice(1).every((bytes) => bytes > 0), given.length]).toEqual([0, true, 4]);
  });

  it("of a filter of nodes", async () => {
    const { THREE } = await adapterFor(VERSIONS[0]![1]);
    const { HiddenPointNodesFilter } = await import("hidden-point-removal/nodes");
    const points = Array.from({ length: 3000 }, (_, i) => [...sphere.subarray(3 * i, 3 * i + 3)]);
    const nodes = [nodeOf(points.slice(0, 1500), [0, 0, 0]), nodeOf(points.slice(1500), [0, 0, 0])];
    const root = new THREE.Group().add(...nodes);
    const camera = new THREE.PerspectiveCamera();
    const filter = new HiddenPointNodesFilter(root, { radius: 5000 });
    for (const place of places) {
      camera.position.fromArray(place);
      camera.updateMatrixWorld();
      do {
        filter.update(camera);
        await new Promise((resolve) => setTimeout(resolve, 5));
      } while (!filter.settled);
      expect(drawnOf(nodes)).toEqual([...direct.visibleFrom(place, { radius: 5000 }).indices]);
    }
    filter.dispose();
    // All nodes are one cloud. It is asked once for each place.
    expect(given.length).toBe(places.length);
    expect([given[0], given.slice(2).every((bytes) => bytes > 0)]).toEqual([0, true]);
  });
});
