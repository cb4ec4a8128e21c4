// What the page asks its filter for, and what it makes of the answers. The worker is a script, and the time is the test's own.
import { HprError } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { prepareCloud } from "../../www/cloud/prepare.js";
import { type Settings, USUAL_SETTINGS, type Viewpoint } from "../../www/settings/settings.js";
import { Inquiry, type TimedView } from "../../www/view/inquiry.js";
import { CloudPoints } from "../../www/view/points.js";
import { THEMES } from "../../www/view/theme.js";

interface Asked {
  options: { looks?: number; radius?: unknown; exponent?: number; origin?: number[] };
  kind: string;
  from: Viewpoint;
  signal: AbortSignal;
  answer: () => void;
  refuse: (error: Error) => void;
}

const HANG = new HprError("internal", "silent; go on", { cause: new DOMException("silent", "TimeoutError") });
/** The middle of the cloud, which a number in single precision cannot tell from its neighbors. */
const CENTER: Viewpoint = [500_000.125, 5_000_000.25, 100];

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
  readonly answers: TimedView[] = [];
  made = 0;
  disposed = 0;
  readonly points: CloudPoints;
  readonly inquiry: Inquiry;
  #at: Viewpoint = [CENTER[0], CENTER[1], CENTER[2] + 5];
  #settings: Settings;

  private constructor(length: number, settings: Partial<Settings>) {
    this.#settings = { ...USUAL_SETTINGS, ...settings };
    const positions = new Float64Array(3 * length);
    for (let i = 0; i < length; i++) positions.set([CENTER[0] + (i % 2), CENTER[1], CENTER[2]], 3 * i);
    positions[0] = CENTER[0] - 1;
    this.points = new CloudPoints(prepareCloud({ positions, colors: null }).cloud, THEMES.dark);
    const another = () => Promise.resolve(this.#cloud(length));
    this.inquiry = new Inquiry(this.#cloud(length), another, this.points, positions);
  }

  static async of(length: number, settings: Partial<Settings> = {}): Promise<Scene> {
    const scene = new Scene(length, settings);
    const first = scene.inquiry.first(scene.#at, scene.#settings);
    await scene.flush();
    scene.asked.at(-1)!.answer();
    await first;
    scene.inquiry.onError = (error) => scene.errors.push(error);
    scene.inquiry.onView = (view) => scene.answers.push(view);
    scene.draw();
    return scene;
  }

  /** The first frame compiles the shader, which shows whether maps can be drawn. */
  draw(): void {
    const { material } = this.points.solid;
    const shader = { vertexShader: material.vertexShader, uniforms: material.uniforms };
    material.onBeforeCompile(shader as never, { capabilities: { isWebGL2: true } } as never);
  }

  #cloud(length: number): WorkerPointCloud {
    this.made += 1;
    const ask = (isMap: boolean, from: Viewpoint, options: Asked["options"] & { signal: AbortSignal }) =>
      new Promise((resolve, reject) => {
        const visibility = { count: 1, indices: new Uint32Array(1) };
        const kind = isMap ? "map" : options.looks === undefined ? "operator" : "looks";
        this.asked.push({
          kind,
          from,
          options,
          signal: options.signal,
          answer: () => resolve(visibility),
          refuse: reject,
        });
      });
    return Object.defineProperties(Object.create(WorkerPointCloud.prototype) as WorkerPointCloud, {
      length: { value: length },
      spacing: { value: 1 },
      visibleFrom: { value: ask.bind(null, false) },
      visibilityMap: { value: ask.bind(null, true) },
      dispose: { value: () => Promise.resolve((this.disposed += 1)) },
    });
  }

  flush = () => new Promise((resolve) => setImmediate(resolve));

  /** A frame. */
  async follow(): Promise<void> {
    this.inquiry.follow(this.#at, this.#settings);
    await this.flush();
    this.inquiry.follow(this.#at, this.#settings);
  }

  async move(x: number): Promise<void> {
    this.#at = [CENTER[0] + x, CENTER[1], CENTER[2] + 5];
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

test("the first view is answered by one hull and looks; at rest a map is made ahead; a move is answered at rest", async () => {
  const scene = await Scene.of(20_000);
  const [first] = scene.asked.splice(0);
  expect([first!.kind, ...(await scene.kinds(100))]).toEqual(["operator", "looks", "map"]);
  expect(scene.inquiry.busy).toBe(false);
  const moving: string[] = [];
  for (let x = 1; x < 4; x++) {
    await scene.move(x);
    expect(scene.inquiry.busy).toBe(true);
    moving.push(...(await scene.kinds(9)));
  }
  expect(moving).toEqual(["map", "map", "map"]);
  expect(await scene.kinds(100)).toEqual(["looks"]);
});

test("frames that take longer than a rest are no rest", async () => {
  const scene = await Scene.of(20_000);
  await scene.kinds(300);
  scene.asked.length = 0;
  for (let x = 1; x < 4; x++) {
    await scene.move(x);
    scene.asked.at(-1)!.answer();
    await scene.flush();
    await vi.advanceTimersByTimeAsync(300);
  }
  expect(scene.asked.splice(0).map(({ kind }) => kind)).toEqual(["map", "map", "map"]);
  expect(await scene.kinds(300)).toEqual(["looks"]);
});

test("the filter is asked from exactly the place in f64, and its maps are drawn around the middle of the cloud", async () => {
  const scene = await Scene.of(20_000);
  await scene.kinds(100);
  scene.asked.length = 0;
  await scene.move(0.1);
  const { from, options } = scene.asked[0]!;
  expect([from, options.origin]).toEqual([[CENTER[0] + 0.1, CENTER[1], CENTER[2] + 5], [...scene.points.cloud.center]]);
});

test("after a change of settings the final answer alone is asked, and nothing known is asked again", async () => {
  const scene = await Scene.of(20_000);
  await scene.kinds(100);
  scene.asked.length = 0;
  for (const [settings, options] of [
    [{ looks: 2 }, { looks: 2 }],
    [
      { looks: 3, thickness: 0.2 },
      { looks: 3, thickness: 0.2 },
    ],
    [{ looks: 0 }, { radius: "auto" }],
    [{ radius: { exponent: 2 } }, { exponent: 2 }],
  ] as const) {
    await scene.set(settings);
    const [asked] = scene.asked;
    expect(asked!.options).toMatchObject(options);
    expect(await scene.kinds(100)).toHaveLength(1);
    expect(scene.answers.at(-1)!.question.method.looks).toBe("looks" in options ? options.looks : 0);
  }
});

test("settings that do not suit a place are said, and asked again from another place", async () => {
  const scene = await Scene.of(1000, { looks: 0 });
  scene.asked.length = 0;
  await scene.set({ radius: { length: 3 } });
  const refuse = async () => {
    scene.asked.splice(0)[0]!.refuse(new HprError("radius", "R is too small."));
    await scene.flush();
    expect(await scene.kinds(100)).toEqual(["operator"]);
    expect(scene.answers.at(-1)!.note).toMatch(/do not suit this cloud or place.*: R is too small\.$/);
  };
  await refuse();
  await scene.move(1);
  expect(scene.asked[0]!.options.radius).toBe(3);
  await refuse();
  await scene.move(2);
  expect(await scene.kinds(100)).toEqual(["operator"]);
  expect(scene.answers.at(-1)!.note).toBeNull();
  expect(scene.errors).toEqual([]);
});

test("a refused question is not asked again", async () => {
  const scene = await Scene.of(20_000);
  scene.asked.length = 0;
  await vi.advanceTimersByTimeAsync(100);
  await scene.follow();
  scene.asked.splice(0)[0]!.refuse(new HprError("too-large", "no memory"));
  await scene.follow();
  expect(await scene.kinds(100)).toEqual([]);
  expect([scene.errors.length, scene.inquiry.busy]).toEqual([1, false]);
});

test("a worker that hangs is replaced once and asked again; after that, another place is asked", async () => {
  const scene = await Scene.of(1000);
  await scene.kinds(100);
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
  await vi.advanceTimersByTimeAsync(1000);
  await scene.move(2);
  await scene.flush();
  expect(await scene.kinds(100)).toEqual(["operator", "looks"]);
  expect([scene.made, scene.errors.length, scene.inquiry.busy]).toEqual([3, 1, false]);
});
