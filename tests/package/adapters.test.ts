// What every adapter promises, with one cloud on the page and with three, which share a worker.
import { init, PointCloud, type VisibilityOptions } from "hidden-point-removal";
import { type FilterChange, HiddenPointFilter } from "hidden-point-removal/three";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { describe, expect, it, vi } from "vitest";

import { ADAPTERS, cameraAt, type Drawn, pageWith, type Place, pointsOf } from "./adapters";
import { watchedWorkers } from "./node-workers";
import { bumpySphere, problemOf } from "./support";
import { drawn } from "./three-support";

const COUNT = 2400;
const HERE: Place = [0, 0, 5];
const THERE: Place = [-3, 1, 0.5];

await init();

const next = (milliseconds = 2) => new Promise((resolve) => setTimeout(resolve, milliseconds));

describe.each(ADAPTERS.map((adapter) => [adapter.name, adapter] as const))("%s", (_, adapter) => {
  const having = (what: NonNullable<typeof adapter.lacks>[number]) => (adapter.lacks?.includes(what) ? it.skip : it);

  describe.each(adapter.clouds)("with %i cloud(s) on the page", (clouds) => {
    const spheres = Array.from({ length: clouds }, (_, k) => bumpySphere(k + 1, COUNT));
    const local = spheres.map((positions) => () => new PointCloud(positions));
    const started = watchedWorkers((worker, number) => {
      if (number <= dying) worker.once("message", () => void worker.terminate());
    });
    let dying = 0;

    const page = (options: object = {}) => pageWith(adapter, spheres, { settle: false, ...options });
    const seen = (place: Place, options: VisibilityOptions = {}) =>
      local.map((cloud) => [...cloud().visibleFrom(place, options).indices]);
    const drawnOf = (all: Drawn[]) => all.map((one) => one.drawn());
    const lookAll = (all: Drawn[], place: Place) => {
      for (const one of all) one.look(place);
    };

    /** Frames from this place until all clouds are at rest. */
    async function rest(all: Drawn[], place: Place): Promise<void> {
      let frames = 0;
      do {
        lookAll(all, place);
        await next();
        if (frames++ > 3000) throw new Error("the clouds do not come to rest");
      } while (!all.every(({ settled }) => settled));
    }

    it("draws the exact answer, and at rest that of `settle`", async () => {
      const all = await page({ exponent: 3, settle: { looks: 3 } });
      expect(drawnOf(all).map(({ length }) => length)).toEqual(spheres.map(() => COUNT));
      expect(all.map(({ answer }) => answer)).toEqual(spheres.map(() => null));
      for (const place of [HERE, THERE]) {
        await rest(all, place);
        expect(started.length).toBe(1);
        const [exact, looks] = [seen(place, { exponent: 3 }), seen(place, { looks: 3 })];
        expect(drawnOf(all)).toEqual(looks);
        all.forEach(({ changes, answer }, k) => {
          expect(answer).toBe("looks");
          expect(changes.splice(0)).toMatchObject([
            { answer: "operator", count: exact[k]!.length },
            { answer: "looks", count: looks[k]!.length },
          ]);
        });
      }
    });

    it("settles while one of the clouds is seen from elsewhere in every frame", async () => {
      const all = await page({ settle: { looks: 3 } });
      const [moving, ...resting] = all;
      let turn = 0;
      do {
        moving!.look([5 * Math.sin((turn += 0.01)), 0, 5 * Math.cos(turn)]);
        lookAll(resting, HERE);
        await next();
        if (turn > 30) throw new Error("the clouds do not come to rest");
      } while (moving!.changes.length < 2 || !resting.every(({ settled }) => settled));
      expect(drawnOf(resting)).toEqual(seen(HERE, { looks: 3 }).slice(1));
      await rest([moving!], HERE);
      expect(drawnOf(all)).toEqual(seen(HERE, { looks: 3 }));
    });

    it.each(["keep", "all"] as const)("with `stale: %s`, until the present view is answered", async (stale) => {
      const all = await page({ stale });
      await rest(all, HERE);
      const before = drawnOf(all);
      lookAll(all, THERE);
      // A frame later, the answer may have come.
      const shown = drawnOf(all).map(({ length }) => length);
      expect(shown).toEqual(stale === "all" ? spheres.map(() => COUNT) : before.map(({ length }) => length));
      await rest(all, THERE);
      expect(drawnOf(all)).toEqual(seen(THERE));
    });

    it("asks again only when the viewpoint has moved, and so far that it can be seen", async () => {
      const all = await page();
      await rest(all, HERE);
      const asked = async (place: Place) => {
        const before = all.map(({ changes }) => changes.length);
        await rest(all, place);
        return all.map(({ changes }, k) => changes.length - before[k]!);
      };
      const { spacing } = local[0]!();
      expect(await asked(HERE)).toEqual(spheres.map(() => 0));
      expect(await asked([0.0005 * spacing, 0, 5])).toEqual(spheres.map(() => 0));
      expect(await asked([0.002 * spacing, 0, 5])).toEqual(spheres.map(() => 1));
    });

    having("direction")("sees along a direction", async () => {
      const all = await page();
      for (const one of all) {
        do {
          one.lookAlong!([0, 0, -1]);
          await next();
        } while (!one.settled);
      }
      expect(drawnOf(all)).toEqual(local.map((cloud) => [...cloud().visibleFromDirection([0, 0, -1]).indices]));
    });

    having("flags")("stays when frozen, and draws everything when it is not enabled", async () => {
      const all = await page();
      const set = (flags: object) => Promise.all(all.map((one) => one.set!(flags)));
      await rest(all, HERE);
      await set({ frozen: true });
      await rest(all, THERE);
      expect(drawnOf(all)).toEqual(seen(HERE));
      await set({ enabled: false });
      lookAll(all, THERE);
      expect(drawnOf(all).map(({ length }) => length)).toEqual(spheres.map(() => COUNT));
      await set({ enabled: true });
      lookAll(all, THERE);
      expect(drawnOf(all)).toEqual(seen(HERE));
      await set({ frozen: false });
      await rest(all, THERE);
      expect(drawnOf(all)).toEqual(seen(THERE));
    });

    having("filter")("takes other settings without being made again", async () => {
      const all = await page({ settle: undefined });
      const filters = all.flatMap(({ filter }) => filter ?? []);
      await rest(all, HERE);
      const set = async (
        asked: Parameters<HiddenPointFilter["setOptions"]>[0],
        options = asked as VisibilityOptions,
      ) => {
        for (const { changes } of all) changes.length = 0;
        for (const filter of filters) filter.setOptions(asked);
        expect(filters.map(({ settled }) => settled)).toEqual(spheres.map(() => false));
        await rest(all, HERE);
        expect(drawnOf(all)).toEqual(seen(HERE, options));
        // At rest the final answer comes at once, and the same options are asked once.
        for (const filter of filters) filter.setOptions({ ...asked });
        await rest(all, HERE);
        expect(all.map(({ changes }) => changes.length)).toEqual(spheres.map(() => 1));
      };
      await set({ exponent: 3 });
      expect(filters.map(({ radius }) => radius)).toEqual(
        local.map((cloud) => cloud().visibleFrom(HERE, { exponent: 3 }).radius),
      );
      await set({ looks: 2 });
      await set({ settle: { looks: 2, thickness: 0.3 } }, { looks: 2, thickness: 0.3 });
      await set({ thickness: 0.3 }, { looks: 3, thickness: 0.3 });
      const change = async (
        name: "exponent" | "looks" | "thickness" | "surface",
        value: unknown,
        options: VisibilityOptions,
      ) => {
        for (const filter of filters) {
          Object.assign(filter, { [name]: value });
          expect(filter[name]).toBe(value);
        }
        await rest(all, HERE);
        expect(drawnOf(all)).toEqual(seen(HERE, options));
      };
      await change("exponent", 2, { exponent: 2 });
      expect(filters.map(({ thickness }) => thickness)).toEqual(spheres.map(() => undefined));
      await change("looks", 2, { looks: 2 });
      expect(filters.map(({ exponent }) => exponent)).toEqual(spheres.map(() => undefined));
      await change("surface", "noisy", { looks: 2, surface: "noisy" });
      await change("surface", undefined, { looks: 2 });
      await change("thickness", 0.3, { looks: 2, thickness: 0.3 });
      await change("looks", undefined, { looks: 3, thickness: 0.3 });
      for (const filter of filters) {
        expect(() => (filter.looks = 5 as never)).toThrow(expect.objectContaining({ code: "option" }));
        for (const wrong of [{ looks: 5 }, { looks: 3, exponent: 2 }, { worker: false }, 3]) {
          expect(() => filter.setOptions(wrong as never)).toThrow(expect.objectContaining({ code: "option" }));
        }
        expect(() => (filter.mode = "fade" as never)).toThrow(expect.objectContaining({ code: "option" }));
        filter.mode = "dim";
        filter.mode = "hide";
        expect([filter.mode, filter.settled]).toEqual(["hide", true]);
      }
      expect(drawnOf(all)).toEqual(seen(HERE, { looks: 3, thickness: 0.3 }));
    });

    having("filter")("tells whether a place without a point is seen", async () => {
      const all = await page({ settle: undefined });
      const filters = all.flatMap(({ filter }) => filter ?? []);
      const early = filters.map((filter) => problemOf(() => filter.sees({ x: 0, y: 0, z: 2 })));
      expect((await Promise.all(early)).map(({ code }) => code)).toEqual(filters.map(() => "option"));
      await rest(all, HERE);
      expect(await Promise.all(filters.map((filter) => filter.sees({ x: 0, y: 0, z: 2 })))).toEqual(
        spheres.map(() => true),
      );
      expect(await Promise.all(filters.map((filter) => filter.sees({ x: 0, y: 0, z: -2 })))).toEqual(
        spheres.map(() => false),
      );
      for (const filter of filters) {
        expect((await problemOf(() => filter.sees({ x: NaN, y: 0, z: 0 }))).code).toBe("viewpoint");
        filter.dispose();
        expect((await problemOf(() => filter.sees({ x: 0, y: 0, z: 2 }))).code).toBe("disposed");
      }
    });

    it("restores everything when it is disposed of, also twice or in the middle of a question", async () => {
      const all = await page();
      await rest(all, HERE);
      lookAll(all, THERE);
      for (const one of all) await one.dispose();
      for (const one of all) await one.dispose();
      await next(20);
      for (const one of all) expect(one.isAsBefore?.()).not.toBe(false);
      if (all[0]!.isAsBefore !== undefined) {
        expect(drawnOf(all).map(({ length }) => length)).toEqual(spheres.map(() => COUNT));
      }
      expect(all.flatMap(({ errors }) => errors)).toEqual([]);
      for (const one of await page()) {
        await one.dispose();
        if (one.filter !== undefined) expect((await problemOf(() => one.filter!.ready)).code).toBe("disposed");
      }
    });

    it("tells of a refusal once until there is an answer, and goes on at places where there is none", async () => {
      const all = await page({ radius: 5 });
      const codes = () => all.map(({ errors }) => errors.map((error) => (error as { code?: string }).code));
      for (const far of [10, 11, 12]) await rest(all, [0, 0, far]);
      const isOnce = all[0]!.filter !== undefined;
      if (isOnce) expect(codes()).toEqual(spheres.map(() => ["radius"]));
      await rest(all, [0, 0, 2]);
      expect(drawnOf(all)).toEqual(seen([0, 0, 2], { radius: 5 }));
      await rest(all, [0, 0, 13]);
      if (isOnce) expect(codes()).toEqual(spheres.map(() => ["radius", "radius"]));
      for (const one of all.map(({ filter }) => filter)) {
        if (one !== undefined) expect((await problemOf(() => one.ready)).code).toBe("radius");
      }
    });

    having("recovery")("recovers from a worker that dies, without a word", async () => {
      dying = 1;
      const all = await page();
      await rest(all, HERE);
      dying = 0;
      expect(drawnOf(all)).toEqual(seen(HERE));
      expect(started.length).toBe(2);
      expect(all.flatMap(({ errors }) => errors)).toEqual([]);
    });
  });

  having("refusal").each<[options: object, words: string]>([
    [{ stale: "draft" }, "stale must be"],
    [{ settle: { looks: 5 } }, "settle: looks"],
    [{ settle: { stale: "all" } }, "settle: unknown option"],
    [{ exponents: 2 }, "unknown option"],
    [{ exponent: "2" }, "exponent"],
    [{ radius: "nearest" }, "radius"],
    [{ settle: 1 }, "settle"],
    [{ mode: "fade" }, "mode"],
    [{ mode: "dim", dimMaterial: {} }, "dimMaterial"],
    [{ worker: 1 }, "worker"],
    [{ nonFinite: "keep" }, "nonFinite"],
    [{ radius: 5, exponent: 2 }, "exclude"],
    [{ moveThreshold: 1 }, "unknown option"],
    [{ thickness: 0.1, exponent: 2 }, "thickness"],
    [{ surface: "rough" }, "surface"],
    [{ looks: 3, scores: true }, "scores"],
  ])("refuses %o", async (options, words) => {
    const problem = await problemOf(() => pageWith(adapter, [bumpySphere(1, COUNT)], options));
    expect(problem).toMatchObject({ code: "option", message: expect.stringContaining(words) as string });
  });

  having("refusal")("reports an error that nobody listens to as an unhandled rejection", async () => {
    const [one] = await pageWith(adapter, [bumpySphere(1, COUNT)], { radius: 1 });
    const filter = one!.filter!;
    vi.spyOn(filter as unknown as { hears(): boolean }, "hears").mockReturnValue(false);
    one!.look(HERE);
    expect((await problemOf(() => filter.ready)).code).toBe("radius");
  });

  describe("with workers that die as soon as they run", () => {
    let dying = 0;
    const started = watchedWorkers((worker, number) => {
      if (number <= dying) worker.once("message", () => void worker.terminate());
    });

    having("refusal")("reports it once, and tries again from another viewpoint", async () => {
      dying = 4;
      const [one] = await pageWith(adapter, [bumpySphere(1, COUNT)], { settle: false });
      do {
        one!.look(HERE);
        await next();
      } while (one!.errors.length === 0);
      expect(one!.errors[0]).toMatchObject({ name: "HprError", code: "internal" });
      for (let frame = 0; frame < 100; frame++) {
        one!.look(HERE);
        await next(1);
      }
      expect(started).toHaveLength(4);
      expect(one!.drawn()).toHaveLength(COUNT);
      const seen = [...new PointCloud(bumpySphere(1, COUNT)).visibleFrom(THERE).indices];
      await expect
        .poll(() => {
          one!.look(THERE);
          return one!.drawn();
        })
        .toEqual(seen);
      expect(started).toHaveLength(5);
      expect(one!.errors).toHaveLength(1);
    });
  });
});

describe("several cameras of one filter", () => {
  it.each(["HiddenPointFilter", "HiddenPointNodesFilter of one node"])("each have their answers: %s", async (name) => {
    const adapter = ADAPTERS.find((one) => one.name === name)!;
    const one = await adapter.make(bumpySphere(1, COUNT), { settle: { looks: 3 } });
    const filter = one.filter as HiddenPointFilter;
    const cloud = new PointCloud(bumpySphere(1, COUNT));
    const cameras = [cameraAt(0, 0, 5), cameraAt(0, 5, 0), cameraAt(5, 0, 0)];
    const [moving, ...resting] = cameras;
    let frames = 0;
    // One that moves in every frame does not keep the others from being answered.
    const isSeen = resting.map(() => false);
    while (!isSeen.every(Boolean)) {
      moving!.position.x = frames++ / 100;
      filter.update(moving!);
      resting.forEach((camera, k) => {
        filter.update(camera);
        isSeen[k] = filter.answer === "looks";
      });
      await next();
      expect(frames).toBeLessThan(30_000);
    }
    for (const camera of resting) {
      filter.update(camera);
      expect(one.drawn()).toEqual([...cloud.visibleFrom(camera.position.toArray(), { looks: 3 }).indices]);
    }
    // Eight cameras are remembered.
    for (let k = 0; k < 8; k++) filter.update(cameraAt(k, 0, 9));
    filter.update(resting[0]!);
    expect(one.drawn()).toHaveLength(COUNT);
    await one.dispose();
  });
});

describe("a filter of a cloud that the page has, in the coordinates of a map", () => {
  const local = bumpySphere(1, COUNT);
  const origin: Place = [500_000.125, 5_000_000.25, 100];
  const placed = (place: Place) => place.map((x, axis) => x + origin[axis]!) as [number, number, number];
  const positions = Float64Array.from(local, (x, i) => x + origin[i % 3]!);
  const cloud = new PointCloud(positions);
  let dying = 0;
  watchedWorkers((worker, number) => {
    if (number <= dying) worker.once("message", () => void worker.terminate());
  });

  /** A filter, all that it tells, and frames until it is at rest. */
  function filtered(options: ConstructorParameters<typeof HiddenPointFilter>[1]) {
    const { points, geometry, camera } = pointsOf(local);
    const filter = new HiddenPointFilter(points, { settle: false, ...options });
    const changes: FilterChange[] = [];
    filter.addEventListener("change", (change) => changes.push(change));
    const rest = async (viewpoint?: Place) => {
      do {
        filter.update(camera, viewpoint);
        await next();
      } while (!filter.settled);
      return drawn(geometry);
    };
    return { filter, changes, rest };
  }

  it("asks in double precision for the camera, or for the viewpoint that `update` gets", async () => {
    const { filter, changes, rest } = filtered({ cloud, origin });
    expect(await rest()).toEqual([...cloud.visibleFrom(placed(HERE)).indices]);
    expect(await filter.sees({ x: 0, y: 0, z: 2 })).toBe(true);
    expect(await rest(placed(THERE))).toEqual([...cloud.visibleFrom(placed(THERE)).indices]);
    expect(changes.map(({ viewpoint }) => viewpoint)).toEqual([placed(HERE), placed(THERE)]);
    for (const { visibility, viewpoint } of changes) {
      const { indices, radius } = cloud.visibleFrom(viewpoint!);
      expect([visibility!.indices, visibility!.radius]).toEqual([indices, radius]);
    }
    filter.dispose();
    expect(cloud.visibleFrom(placed(HERE)).count).toBeGreaterThan(0);
  });

  it("makes it again when its worker is lost, and disposes of it", async () => {
    dying = 1;
    const made: WorkerPointCloud[] = [];
    const { filter, rest } = filtered({
      origin,
      cloud: () => WorkerPointCloud.create(positions, { workers: 1 }).then((one) => (made.push(one), one)),
    });
    expect(await rest()).toEqual([...cloud.visibleFrom(placed(HERE)).indices]);
    dying = 0;
    filter.dispose();
    expect((await problemOf(() => made.at(-1)!.visibleFrom(placed(HERE)))).code).toBe("disposed");
  });

  it.each<[options: object, words: string]>([
    [{ origin }, "origin needs the option cloud"],
    [{ cloud, origin: [1, 2] }, "origin"],
    [{ cloud: 3 }, "cloud must be"],
    [{ cloud: new PointCloud(local.slice(3)) }, "2400 points"],
    [{ cloud: () => Promise.resolve(new PointCloud(local.slice(3))) }, "2400 points"],
  ])("refuses %o", async (options, words) => {
    const problem = await problemOf(() => filtered(options).filter.ready);
    expect(problem).toMatchObject({ message: expect.stringContaining(words) as string });
  });
});
