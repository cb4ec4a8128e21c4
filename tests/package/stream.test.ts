// The stream of answers for a viewpoint that moves: `follow` of the worker client. adapters.test.ts has what it shares with filters.
import type { StreamedAnswer, WorkerPointCloud as Cloud } from "hidden-point-removal/worker";
import { afterEach, beforeAll, describe, expect, it, vi } from "vitest";

import { OriginalWorker, replaceWorker, workersAfter } from "./node-workers";
import { bumpySphere, readyPackage } from "./support";

const { HprError, PointCloud, WorkerPointCloud } = await readyPackage();

const many = bumpySphere(5, 60_000);
const few = bumpySphere(6, 3000);
const local = new PointCloud(many);
const clouds: Cloud[] = [];
let cloud: Cloud;

async function cloudOf(positions: Float32Array, options = {}): Promise<Cloud> {
  const created = await WorkerPointCloud.create(positions, options);
  clouds.push(created);
  return created;
}

beforeAll(async () => {
  cloud = await cloudOf(many);
  clouds.length = 0;
});

afterEach(async () => {
  await Promise.all(clouds.splice(0).map((one) => one.dispose()));
});

/** A stream, all of its answers, and its errors. */
function follow(options: object = {}, of = cloud) {
  const answers: StreamedAnswer[] = [];
  const errors: Error[] = [];
  const stream = of.follow({
    settle: false,
    ...options,
    onAnswer: (answer: StreamedAnswer) => answers.push(answer),
    onError: (error: Error) => errors.push(error),
  });
  return { stream, answers, errors, kinds: () => answers.map(({ answer }) => answer) };
}

const settled = (stream: { settled: boolean }) => expect.poll(() => stream.settled, { interval: 2 }).toBe(true);
const at = (angle: number) => [5 * Math.sin(angle), 1, 5 * Math.cos(angle)];

describe("a stream", () => {
  it("gives the exact answer, and at rest the answer that `settle` asks for", async () => {
    const { stream, answers, kinds, errors } = follow({ exponent: 3, settle: { looks: 3, scores: true } });
    expect([stream.last, stream.visible]).toEqual([null, null]);
    const begun = performance.now();
    stream.look(at(0));
    await settled(stream);
    expect(performance.now() - begun).toBeGreaterThanOrEqual(100);
    expect(kinds()).toEqual(["operator", "looks"]);
    const [exact, looks] = answers.map(({ visibility }) => visibility) as [never, never];
    expect(exact).toEqual(local.visibleFrom(at(0), { exponent: 3 }));
    expect(looks).toEqual(local.visibleFrom(at(0), { looks: 3, scores: true }));
    expect(answers[0]).toMatchObject({ viewpoint: at(0), direction: null });
    expect(stream.last).toBe(answers[1]);
    expect(stream.visible).toBe(answers[1]!.visibility.indices);
    stream.look(at(0));
    await settled(stream);
    expect([kinds().length, errors]).toEqual([2, []]);
    stream.dispose();
  });

  it("gives answers in motion, and the answer at rest of the last view alone", async () => {
    const { stream, answers } = follow({ settle: { looks: 2 } });
    let angle = 0;
    // A busy machine may sleep for longer than a rest.
    const clock = vi.spyOn(performance, "now").mockReturnValue(performance.now());
    // A new view comes before each answer, as with a camera that moves in each frame.
    for (; angle < 1; angle += 0.01) {
      stream.look(at(angle));
      await new Promise((next) => setTimeout(next, 1));
    }
    clock.mockRestore();
    await settled(stream);
    const moving = answers.filter(({ answer }) => answer === "operator");
    expect(moving.length).toBeGreaterThan(1);
    expect(answers.map(({ answer }) => answer).indexOf("looks")).toBe(answers.length - 1);
    expect(stream.last!.visibility).toEqual(local.visibleFrom(moving.at(-1)!.viewpoint!, { looks: 2 }));
    for (const { visibility, viewpoint } of moving.slice(0, 5)) {
      expect(visibility.indices).toEqual(local.visibleFrom(viewpoint!).indices);
    }
    stream.dispose();
  });

  it("gives the newest answer to an iterator, and ends it", async () => {
    const stream = cloud.follow();
    stream.look(at(2));
    const seen: string[] = [];
    for await (const { answer, visibility } of stream) {
      seen.push(answer);
      expect(visibility.count).toBeGreaterThan(0);
      if (answer === "operator") stream.dispose();
    }
    expect(seen.at(-1)).toBe("operator");
    stream.dispose();
  });

  it("asks again after the cloud has changed", async () => {
    const changing = await cloudOf(few);
    const { stream, answers } = follow({}, changing);
    stream.look([0, 0, 5]);
    await settled(stream);
    await changing.append([0, 0, 4]);
    stream.look([0, 0, 5]);
    await settled(stream);
    expect(answers).toHaveLength(2);
    expect(answers[1]!.visibility.indices.at(-1)).toBe(3000);
    stream.dispose();
  });

  it("rejects an iterator with a refusal", async () => {
    const awaited = cloud.follow({ radius: 5 });
    awaited.look([0, 0, 50]);
    await expect(awaited[Symbol.asyncIterator]().next()).rejects.toMatchObject({ code: "radius" });
    awaited.dispose();
  });

  it("refuses bad options and viewpoints", () => {
    for (const [options, words] of [
      [{ settle: 3 }, "plain object"],
      [{ settle: { looks: 4 } }, "settle: looks"],
      [{ settle: { looks: 3, exponent: 2 } }, "settle: looks and exponent"],
      [{ settle: { stale: "all" } }, "settle: unknown option"],
      [{ stale: "none" }, "stale must be"],
      [{ stale: "draft" }, "stale must be"],
      [{ moveThreshold: 0.1 }, "unknown option"],
      [{ onAnswer: 7 }, "onAnswer must be"],
      [{ latest: true }, "unknown option"],
    ] as const) {
      expect(() => cloud.follow(options as object)).toThrow(
        expect.objectContaining({ code: "option", message: expect.stringContaining(words) as string }),
      );
    }
    const stream = cloud.follow();
    expect(() => stream.look([1, 2])).toThrow(HprError);
    stream.dispose();
  });

  it("ends quietly with its cloud", async () => {
    const gone = await cloudOf(few);
    const { stream, errors } = follow({}, gone);
    stream.look([0, 0, 5]);
    await gone.dispose();
    stream.look([0, 1, 5]);
    await expect.poll(() => stream.settled).toBe(true);
    expect(errors).toEqual([]);
    expect(() => gone.follow()).toThrow(expect.objectContaining({ code: "disposed" }));
  });

  it("serves two cameras of one cloud, each with its own answers", async () => {
    const [left, right] = [follow(), follow({ exponent: 2 })];
    for (let step = 0; step < 5; step++) {
      left.stream.look(at(step / 10));
      right.stream.look(at(3 + step / 10));
      await new Promise((next) => setTimeout(next, 5));
    }
    await Promise.all([settled(left.stream), settled(right.stream)]);
    expect(left.stream.last!.visibility).toEqual(local.visibleFrom(at(0.4)));
    expect(right.stream.last!.visibility).toEqual(local.visibleFrom(at(3.4), { exponent: 2 }));
    left.stream.dispose();
    right.stream.dispose();
  });
});

it.each([1, 2])("a view in slices is given up when its signal aborts, with %i workers", async (workers) => {
  const one = await cloudOf(many, { workers });
  for (const options of [{}, { looks: 3 as const }]) {
    const controller = new AbortController();
    const given = one.visibleFrom(at(0), { ...options, signal: controller.signal });
    await Promise.resolve();
    controller.abort();
    await expect(given).rejects.toMatchObject({ name: "AbortError" });
    // The answer that comes next does not depend on what was given up.
    expect(await one.visibleFrom(at(0), options)).toEqual(local.visibleFrom(at(0), options));
    const { signal } = new AbortController();
    expect(await one.visibleFrom(at(1), { ...options, signal })).toEqual(local.visibleFrom(at(1), options));
  }
});

it("a view in slices lets other clouds of the shared worker be answered in between", async () => {
  // The worker begins when both questions are there, however slow this thread is.
  const gate = new Int32Array(new SharedArrayBuffer(4));
  const waits = `const { parentPort, workerData } = require("node:worker_threads");
    parentPort.on("message", ({ content }) => content.sliced && Atomics.wait(workerData, 0, 0))`;
  replaceWorker(workersAfter(waits, gate));
  const [large, small] = await Promise.all([
    cloudOf(bumpySphere(1, 400_000), { shared: true }),
    cloudOf(few, { shared: true }),
  ]);
  replaceWorker(OriginalWorker);
  const order: string[] = [];
  const { signal } = new AbortController();
  const asked = [
    large.visibleFrom(at(0), { looks: 2, signal }).then(() => order.push("large")),
    small.visibleFrom(at(0)).then(() => order.push("small")),
  ];
  Atomics.store(gate, 0, 1);
  Atomics.notify(gate, 0);
  await Promise.all(asked);
  expect(order).toEqual(["small", "large"]);
});
