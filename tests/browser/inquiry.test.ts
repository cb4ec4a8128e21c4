// How the page's answers follow the viewpoint and the settings. The worker is a script, and the time is the test's own.
import { HprError } from "hidden-point-removal";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { Inquiry } from "../../www/ask/inquiry.js";
import type { WorkerCloud } from "../../www/ask/question.js";
import { type Settings, USUAL_SETTINGS, type Viewpoint } from "../../www/settings/settings.js";

interface Asked {
  kind: string;
  signal: AbortSignal;
  answer: () => void;
  refuse: (error: Error) => void;
}

const HANG = new HprError("internal", "silent; go on", { cause: new DOMException("silent", "TimeoutError") });

beforeEach(() => {
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout", "performance"] });
});

afterEach(() => {
  vi.useRealTimers();
});

/** An inquiry about a cloud with this number of points, after its first answer. */
class Scene {
  readonly asked: Asked[] = [];
  readonly errors: unknown[] = [];
  made = 0;
  disposed = 0;
  readonly inquiry: Inquiry;
  #at: Viewpoint = [0, 0, 5];
  #settings: Settings;

  private constructor(length: number, settings: Partial<Settings>) {
    this.#settings = { ...USUAL_SETTINGS, ...settings };
    this.inquiry = new Inquiry(this.#cloud(length), () => Promise.resolve(this.#cloud(length)), 1);
    this.inquiry.onError = (error) => this.errors.push(error);
  }

  static async of(length: number, settings: Partial<Settings> = {}): Promise<Scene> {
    const scene = new Scene(length, settings);
    const first = scene.inquiry.first(scene.#at, scene.#settings);
    await scene.flush();
    scene.asked.at(-1)!.answer();
    await first;
    return scene;
  }

  #cloud(length: number): WorkerCloud {
    this.made += 1;
    const ask = (kind: string, signal: AbortSignal) =>
      new Promise((resolve, reject) => {
        const visibility = { count: 1, indices: new Uint32Array(1) };
        this.asked.push({
          kind,
          signal,
          answer: () => {
            resolve(visibility);
          },
          refuse: reject,
        });
      });
    const points = {
      length,
      spacing: 1,
      visibleFrom: (_: unknown, { kind, signal }: { kind: string; signal: AbortSignal }) => ask(kind, signal),
      visibilityMap: () => ask("map", new AbortController().signal),
      dispose: () => Promise.resolve((this.disposed += 1)),
    };
    const options = ({ looks }: { looks: number }) => ({ kind: looks > 0 ? "looks" : "operator" });
    return { points, center: [0, 0, 0], options } as unknown as WorkerCloud;
  }

  flush = () => new Promise((resolve) => setImmediate(resolve));

  /** A frame. */
  async follow(): Promise<void> {
    this.inquiry.follow(this.#at, this.#settings);
    await this.flush();
    this.inquiry.follow(this.#at, this.#settings);
  }

  async move(x: number): Promise<void> {
    this.#at = [x, 0, 5];
    await this.follow();
  }

  async set(settings: Partial<Settings>): Promise<void> {
    this.#settings = { ...this.#settings, ...settings };
    await this.follow();
  }

  /** What was asked since the last call, where each question is answered at once. `rest`: milliseconds between frames. */
  async kinds(rest: number): Promise<string[]> {
    const kinds = [];
    for (let frame = 0; frame < 4; frame++) {
      await this.follow();
      const asked = this.asked.splice(0);
      kinds.push(...asked.map(({ kind }) => kind));
      for (const { answer } of asked) answer();
      await this.flush();
      await vi.advanceTimersByTimeAsync(rest);
    }
    await this.follow();
    return kinds;
  }
}

test("the first view is answered by one hull and looks; a move by maps, and by looks at rest", async () => {
  const scene = await Scene.of(100_000);
  expect([scene.asked.splice(0)[0]!.kind, ...(await scene.kinds(0))]).toEqual(["operator", "looks", "map"]);
  expect(scene.inquiry.busy).toBe(false);
  const moving = [];
  for (let x = 1; x < 4; x++) {
    await scene.move(x);
    expect(scene.inquiry.busy).toBe(true);
    moving.push(...(await scene.kinds(9)));
  }
  expect(moving).toEqual(["map", "map", "map"]);
  expect(await scene.kinds(40)).toEqual([]);
  expect(await scene.kinds(250)).toEqual(["looks"]);
});

test("frames that take longer than a rest are no rest", async () => {
  const scene = await Scene.of(100_000);
  await scene.kinds(250);
  scene.asked.length = 0;
  for (let x = 1; x < 4; x++) {
    await scene.move(x);
    scene.asked.at(-1)!.answer();
    await scene.flush();
    await vi.advanceTimersByTimeAsync(300);
  }
  expect(scene.asked.splice(0).map(({ kind }) => kind)).toEqual(["map", "map", "map"]);
  expect(await scene.kinds(1)).toEqual(["looks"]);
});

test("a small cloud is asked by one hull and looks, and by no maps", async () => {
  const small = await Scene.of(1000);
  expect([small.asked.splice(0)[0]!.kind, ...(await small.kinds(250))]).toEqual(["operator", "looks"]);
});

test("after a change of settings the final answer alone is asked, and nothing known is asked again", async () => {
  const scene = await Scene.of(100_000);
  scene.asked.length = 0;
  await scene.kinds(250);
  for (const [settings, kinds] of [
    [{ looks: 2 }, ["looks"]],
    [{ looks: 0 }, ["operator"]],
    [{ radius: { exponent: 2 } }, ["operator"]],
  ] as const) {
    await scene.set(settings);
    expect(await scene.kinds(250)).toEqual(kinds);
  }
});

test("a later stage is given up when the view moves on, and the first one never", async () => {
  const scene = await Scene.of(100_000);
  scene.asked.length = 0;
  await scene.follow();
  const [hull] = scene.asked.splice(0);
  await scene.follow();
  expect(hull!.signal.aborted).toBe(false);
  await scene.move(1);
  expect(hull!.signal.aborted).toBe(true);
  hull!.refuse(new DOMException("moved on", "AbortError"));
  await scene.follow();
  const [map] = scene.asked.splice(0);
  await scene.move(2);
  expect([map!.kind, map!.signal.aborted, scene.errors]).toEqual(["map", false, []]);
});

test("a refused question is not asked again", async () => {
  const scene = await Scene.of(100_000);
  scene.asked.length = 0;
  await scene.follow();
  scene.asked.splice(0)[0]!.refuse(new HprError("too-large", "no memory"));
  await scene.follow();
  expect(await scene.kinds(250)).toEqual([]);
  expect([scene.errors.length, scene.inquiry.busy]).toEqual([1, false]);
});

test("a worker that hangs is replaced once and asked again; after that, `restart` replaces it", async () => {
  const scene = await Scene.of(1000);
  scene.asked.length = 0;
  await scene.move(1);
  const hang = async () => {
    scene.asked.splice(0)[0]!.refuse(HANG);
    await scene.flush();
    await vi.advanceTimersByTimeAsync(1);
    await scene.follow();
  };
  await hang();
  expect([scene.made, scene.disposed, scene.errors, scene.inquiry.busy]).toEqual([2, 1, [], true]);
  await hang();
  expect([scene.made, scene.errors, scene.inquiry.busy]).toEqual([2, [HANG], false]);
  await scene.move(2);
  expect([scene.asked.length, scene.inquiry.busy]).toEqual([0, false]);
  scene.inquiry.restart();
  expect(await scene.kinds(250)).toEqual(["operator", "looks"]);
  expect([scene.made, scene.errors.length, scene.inquiry.busy]).toEqual([3, 1, false]);
});
