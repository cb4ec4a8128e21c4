// Requests to one worker: their order, what overtakes them, and what gives them up.
import { afterEach, beforeEach, describe, expect, it } from "vitest";

import { replaceWorker } from "./node-workers";
import { found, heldBy, ScriptedWorker, scripted, until, useOwnWorkers, useScriptedWorkers } from "./scripted-workers";
import { bumpySphere, freshPackage, problemOf, readyPackage, wasmBytes } from "./support";

const { WorkerPointCloud } = await readyPackage();

const points = bumpySphere(1, 100);
const at = (z: number) => [0, 0, z];

beforeEach(useScriptedWorkers);
afterEach(useOwnWorkers);

const cloudInOne = () => heldBy(1, WorkerPointCloud.create(points), 100);
const sent = () => scripted[0]!.posted.slice(1);
const places = () => sent().map(({ viewpoint }) => (viewpoint as number[])[2]);
const answer = () => {
  scripted[0]!.answers(found([], 100));
};

describe("requests", () => {
  it("are sent in order, each after the reply to the one before", async () => {
    const cloud = await cloudInOne();
    const asked = [1, 2, 3].map((z) => cloud.visibleFrom(at(z)));
    for (const known of [[1], [1, 2], [1, 2, 3]]) {
      expect(places()).toEqual(known);
      scripted[0]!.answers(found(known, 100));
    }
    expect((await Promise.all(asked)).map(({ count }) => count)).toEqual([1, 2, 3]);
  });

  it("that wait are overtaken by a newer one of the same method, if both have `latest`", async () => {
    const cloud = await cloudInOne();
    const latest = true;
    const running = cloud.visibleFrom(at(1), { latest });
    const overtaken = problemOf(() => cloud.visibleFrom(at(2), { latest }));
    const others = [
      cloud.visibleFrom(at(3)),
      cloud.visibleFrom(at(4), { latest: false }),
      cloud.autoRadius(at(5), "auto", { latest }),
    ];
    const newest = cloud.visibleFrom(at(6), { latest });
    expect(await overtaken).toMatchObject({ name: "AbortError", message: "overtaken by a newer request" });
    for (let reply = 0; reply < 5; reply++) answer();
    await Promise.all([running, newest, ...others]);
    expect(places()).toEqual([1, 3, 4, 5, 6]);
  });

  it("that were aborted before overtake nothing, and those aborted while they wait are not sent", async () => {
    const cloud = await cloudInOne();
    const controller = new AbortController();
    const running = cloud.visibleFrom(at(1));
    const waiting = cloud.visibleFrom(at(2), { latest: true });
    const aborted = [
      problemOf(() => cloud.visibleFrom(at(3), { latest: true, signal: AbortSignal.abort() })),
      problemOf(() => cloud.visibleFrom(at(4), { signal: controller.signal })),
    ];
    controller.abort();
    const last = cloud.visibleFrom(at(5), { signal: new AbortController().signal });
    for (const problem of await Promise.all(aborted)) expect(problem.name).toBe("AbortError");
    for (let reply = 0; reply < 3; reply++) answer();
    await Promise.all([running, waiting, last]);
    expect(places()).toEqual([1, 2, 5]);
    expect(sent().map(({ sliced }) => sliced)).toEqual([false, false, true]);
  });

  it("are refused after dispose(), and so are those that wait", async () => {
    const cloud = await cloudInOne();
    const pending = [cloud.visibleFrom(at(1)), cloud.append(points)].map((asked) => problemOf(() => asked));
    await cloud.dispose();
    pending.push(
      ...[
        () => cloud.visibleFrom(at(2)),
        () => cloud.coverage([at(2)]),
        () => cloud.append(points),
        () => cloud.remove([1]),
        () => cloud.follow(),
      ].map(problemOf),
    );
    for (const problem of await Promise.all(pending)) {
      expect(problem).toMatchObject({ code: "disposed", message: "this cloud has been disposed of" });
    }
    expect(sent()).toHaveLength(1);
  });

  it("of a stream have a viewpoint of the cloud's own dimension", async () => {
    const flat = await heldBy(1, WorkerPointCloud.create(points, { dimension: 2 }), 150);
    const stream = flat.follow();
    stream.look([1, 2]);
    await until(() => sent().length === 1);
    expect(sent()[0]).toMatchObject({ kind: "visibleFrom", viewpoint: [1, 2, 0] });
    stream.dispose();
    await flat.dispose();
  });

  it("of every method ask for what the method is given", async () => {
    const cloud = await cloudInOne();
    const triangles = new Uint32Array(0);
    const calls: [ask: () => Promise<unknown>, request: object, value: object, result: unknown][] = [
      [
        () => cloud.visibleFromDirection(at(1)),
        { kind: "visibleFromDirection", direction: at(1) },
        found([1], 100),
        { count: 1 },
      ],
      [
        () => cloud.visibleFromAny([at(1), at(2)]),
        { kind: "visibleFromSeveral", viewpoints: Float64Array.of(0, 0, 1, 0, 0, 2), k: 1 },
        found([1, 2], 100),
        { count: 2 },
      ],
      [
        () => cloud.visibleFromAtLeast(2, [at(1), at(2)]),
        { kind: "visibleFromSeveral", viewpoints: Float64Array.of(0, 0, 1, 0, 0, 2), k: 2 },
        found([], 100),
        { count: 0 },
      ],
      [
        () => cloud.sees(at(1), [1, 2, 3]),
        { kind: "sees", viewpoint: at(1), positions: Float64Array.of(1, 2, 3) },
        { seen: Uint8Array.of(1) },
        Uint8Array.of(1),
      ],
      [
        () => cloud.reconstruct(at(1), { maxEdge: 2 }),
        { kind: "reconstruct", viewpoint: at(1), maxEdge: 2 },
        { ...found([1], 100), triangles },
        { count: 1, triangles },
      ],
      [
        () => cloud.illuminate([at(1)], { ambient: 0.5 }),
        { kind: "illuminate", lights: Float64Array.of(0, 0, 1), ambient: 0.5 },
        { brightness: Float32Array.of(1) },
        Float32Array.of(1),
      ],
    ];
    for (const [ask, request, value, result] of calls) {
      const asked = ask();
      expect(sent().at(-1)).toMatchObject(request);
      scripted[0]!.answers(value);
      expect(await asked).toMatchObject(result as object);
    }
  });
});

describe("a cloud", () => {
  it("that was given up before is not started", async () => {
    const creating = WorkerPointCloud.create(points, { signal: AbortSignal.abort() });
    expect((await problemOf(() => creating)).name).toBe("AbortError");
    expect(scripted).toHaveLength(0);
  });

  it("has no workers left if one of them cannot be started", async () => {
    const cause = new Error("no more threads");
    replaceWorker(
      class extends ScriptedWorker {
        constructor() {
          if (scripted.length === 2) throw cause;
          super();
        }
      } as never,
    );
    const problem = await problemOf(() => WorkerPointCloud.create(points, { workers: 3 }));
    expect(problem).toMatchObject({ code: "load", cause });
    expect(scripted.map(({ isEnded }) => isEnded)).toEqual([true, true]);
  });

  it("is not created if its worker ends while the wasm is being loaded", async () => {
    const fresh = await freshPackage();
    const { readable, writable } = new TransformStream<Uint8Array, Uint8Array>();
    const loading = fresh.init(new Response(readable, { headers: { "content-type": "application/wasm" } }));
    const creating = problemOf(() => fresh.WorkerPointCloud.create(points));
    await until(() => scripted.length === 1);
    scripted[0]!.isReady();
    // The start of the worker has time to end.
    for (let turn = 0; turn < 5; turn++) await new Promise((resolve) => setImmediate(resolve));
    scripted[0]!.emit("exit", 3);
    const writer = writable.getWriter();
    await writer.write(wasmBytes());
    await writer.close();
    await loading;
    expect(await creating).toMatchObject({ code: "internal", cause: "it ended with exit code 3" });
  });

  it("says why its positions cannot be given away", async () => {
    const shared = new Float32Array(new SharedArrayBuffer(12));
    for (const positions of [[1, 2, 3], shared]) {
      const problem = await problemOf(() => WorkerPointCloud.create(positions, { transfer: true }));
      expect(problem.code).toBe("option");
      expect(problem.message).toContain(String(problem.cause));
      expect(problem.cause).toBeInstanceOf(Error);
    }
  });
});
