// The layer for deck.gl: its filter values, and the points that are drawn and picked.
import type { Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, expect, it } from "vitest";
import { newPage } from "./browser.js";
import { builtPage } from "./built.js";
import type { DeckPage } from "./deck/page.js";
import { serveModules } from "./modules.js";

let site: Awaited<ReturnType<typeof serveModules>>;
let path: string;
let page: Page;

beforeAll(async () => {
  path = await builtPage("deck");
  site = await serveModules({});
});

// A page that stays goes on drawing.
afterEach(() => page.context().close());

afterAll(() => {
  site.close();
});

beforeEach(async () => {
  page = await newPage({ viewport: { width: 300, height: 300 } });
  await page.goto(site.address + path);
  await reached(({ answers }) => answers.length > 0);
});

async function reached(test: (page: DeckPage) => boolean): Promise<void> {
  await page.waitForFunction(`(${test.toString()})(globalThis.page)`);
}

function inPage<T>(look: (page: DeckPage) => T | Promise<T>): Promise<T> {
  return page.evaluate(`(${look.toString()})(globalThis.page)`);
}

/** Waits for the values of the newest answer. Returns the points that they show, and the package's answer. */
async function compared() {
  await reached(({ answers, values }) => values().reduce((sum, value) => sum + value, 0) === answers.at(-1)!.count);
  return inPage(async ({ values, camera, visibleFrom }) => ({
    visible: values().flatMap((value, i) => (value === 1 ? [i] : [])),
    expected: await visibleFrom(camera()),
  }));
}

it("is filtered by the mask of the points that the camera sees, wherever it goes", async () => {
  const before = await compared();
  expect(before.visible).toEqual(before.expected);
  expect(before.visible.length).toBeLessThan(2400);
  await inPage(({ set }) => {
    set({}, { rotationX: -60, rotationOrbit: 20 });
  });
  await reached(({ answers }) => answers.length === 2);
  const after = await compared();
  expect(after.visible).toEqual(after.expected);
  expect(after.visible).not.toEqual(before.visible);
  // The same view again asks nothing.
  await inPage(({ set }) => {
    set({ pointSize: 3 });
  });
  await inPage(({ set }) => {
    set({}, { rotationX: 90, rotationOrbit: 0 });
  });
  await reached(({ answers }) => answers.length === 3);
  expect((await compared()).visible).toEqual(before.visible);
  expect(await inPage(({ errors }) => errors)).toEqual([]);
});

it("lets only visible points be picked", async () => {
  const picks = () =>
    inPage(async ({ pick }) => {
      const picked: number[] = [];
      for (let i = 0; i < 30; i++) {
        const index = await pick(120 + (i % 6) * 9, 120 + Math.floor(i / 6) * 11);
        if (index !== undefined) picked.push(index);
      }
      return picked;
    });
  const [visible, front] = [new Set((await compared()).visible), await picks()];
  expect(front.length).toBeGreaterThan(10);
  expect(front.every((index) => visible.has(index))).toBe(true);
  expect(front.filter((index) => index % 2 === 1).length).toBeLessThan(3);
});

it("draws and picks by a map while the camera moves", async () => {
  const found = await inPage(async (page) => {
    // A bumpy ball of 20,000 points far from the origin.
    const [COUNT, HOME] = [20_000, 4_000_000];
    const value = new Float64Array(3 * COUNT);
    for (let i = 0; i < COUNT; i++) {
      const up = 1 - (2 * (i + 0.5)) / COUNT;
      const radius = (1 + 0.1 * Math.sin(16.8 * i)) * Math.sqrt(1 - up * up);
      value.set([HOME + radius * Math.cos(2.399963 * i), up, radius * Math.sin(2.399963 * i)], 3 * i);
    }
    page.answers.length = 0;
    const data = { length: COUNT, attributes: { getPosition: { value, size: 3 } } };
    const turn = (rotationOrbit: number) => {
      page.set(
        { data: data as never, pointSize: 0.5 },
        { zoom: 7, target: [HOME, 0, 0], rotationOrbit, rotationX: 20 },
      );
    };
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    turn(0);
    while (page.answers.length === 0) await frame();
    await frame();
    const rest = await page.drawn();
    let degrees = 0;
    const orbit = async () => {
      do {
        turn((degrees += 0.5));
        await frame();
      } while (!page.isMapped() && degrees < 150);
    };
    await orbit();
    const isMapped = page.isMapped();
    const moving = await page.drawn();
    const exact = new Set(await page.visibleFrom(page.camera(), [...value]));
    // Nothing is left out any more when the layer draws all points.
    page.set({ visibility: { exponent: 3, stale: "all" } });
    await frame();
    // No answer comes before the picture is read.
    page.silence();
    turn(degrees + 1);
    await frame();
    return {
      rest: rest.length,
      moving: moving.length,
      isMapped,
      hidden: moving.filter((i) => !exact.has(i)).length,
      all: (await page.drawn()).length,
      errors: page.errors,
    };
  });
  console.log(found);
  expect(found.errors).toEqual([]);
  expect(found.isMapped).toBe(true);
  expect(found.moving).toBeGreaterThan(0.95 * found.rest);
  expect(found.hidden).toBeLessThan(0.2 * found.moving);
  expect(found.all).toBeGreaterThan(1.3 * found.moving);
});

it("takes any data, a viewpoint and other options", async () => {
  await inPage(({ set }) => {
    set({
      data: [{ at: [0, 0, 1] }, { at: [0, 0, 2] }, { at: [1, 0, 0] }] as never,
      getPosition: (({ at }: { at: number[] }) => at) as never,
      viewpoint: [0, 0, -5],
    });
  });
  await reached(({ answers, values }) => answers.at(-1)!.count === 2 && values().join() === "1,0,1");
  await inPage(({ set }) => {
    set({ viewpoint: [0, 0, 5] });
  });
  await reached(({ values }) => values().join() === "0,1,1");
  expect(await inPage(({ errors }) => errors)).toEqual([]);
  await inPage(({ set }) => {
    set({ visibility: { radius: 0.1 } });
  });
  await reached(({ errors }) => errors.length > 0);
  expect(await inPage(({ errors }) => errors)).toEqual(["radius"]);
  await inPage(({ set }) => {
    set({ data: [{ at: [NaN, 0, 1] }] as never });
  });
  await reached(({ errors }) => errors.length > 1);
  expect(await inPage(({ errors }) => errors.at(-1))).toBe("non-finite");
  // The layer does not draw scores.
  await inPage(({ set }) => {
    set({ visibility: { looks: 3, scores: true } });
  });
  await reached(({ errors }) => errors.length > 2);
  expect(await inPage(({ errors }) => errors.at(-1))).toBe("option");
});

it("reports when the next worker is lost, too, and stops asking", async () => {
  await inPage(({ killWorkerWhenAsked, set }) => {
    killWorkerWhenAsked(2);
    set({}, { rotationX: -60, rotationOrbit: 20 });
  });
  await reached(({ errors }) => errors.length > 0);
  await inPage(({ set }) => {
    set({}, { rotationX: 90, rotationOrbit: 0 });
  });
  await inPage(() => new Promise((resolve) => setTimeout(resolve, 300)));
  expect(await inPage(({ errors, workers, answers }) => [errors, workers(), answers.length])).toEqual([
    ["internal"],
    2,
    1,
  ]);
  // New data gets a new worker.
  await inPage(({ set }) => {
    set({ data: { length: 1, attributes: { getPosition: { value: new Float32Array(3), size: 3 } } } as never });
  });
  await reached(({ answers }) => answers.at(-1)!.count === 1);
});

it("takes the eye of a geospatial camera, in meters and in degrees, with a matrix", async () => {
  // Enlarged 100 times: discs of 200 m, seen from 500 m above, beside their middle.
  const shown = async () => {
    await reached(({ answers, values }) => values().reduce((sum, value) => sum + value, 0) === answers.at(-1)?.count);
    return inPage(({ values }) => values().flatMap((value, i) => (value === 1 ? [i] : [])));
  };
  const expected = await inPage(({ visibleFrom }) => visibleFrom([0.3, -0.5, 5]));
  await inPage((page) => {
    page.answers.length = 0;
    page.lookFrom([11.57, 48.14], [30, -50, 500], {
      coordinateSystem: "meter-offsets",
      coordinateOrigin: [11.57, 48.14, 0],
      modelMatrix: [100, 0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0, 0, 0, 1] as never,
    });
  });
  await reached(({ answers }) => answers.at(-1)?.answer === "operator");
  const inMeters = await shown();
  expect(inMeters.length).toBeLessThan(2400);
  expect(differences(inMeters, expected)).toBeLessThan(10);

  await inPage((page) => {
    const { positions } = page;
    const [east, north] = [100 / (111_194.9 * Math.cos((48.14 * Math.PI) / 180)), 100 / 111_194.9];
    const degrees = Float64Array.from(positions, (x, i) => {
      return i % 3 === 0 ? 11.57 + x * east : i % 3 === 1 ? 48.14 + x * north : 100 * x;
    });
    page.answers.length = 0;
    page.lookFrom([11.57, 48.14], [30, -50, 500], {
      data: { length: degrees.length / 3, attributes: { getPosition: { value: degrees, size: 3 } } } as never,
      coordinateSystem: "lnglat",
      modelMatrix: null,
    });
  });
  await reached(({ answers }) => answers.at(-1)?.answer === "operator");
  expect(differences(await shown(), expected)).toBeLessThan(10);
  expect(await inPage(({ errors }) => errors)).toEqual([]);

  // Coordinates of deck.gl's own have no place for the camera. The refusal comes once.
  await inPage((page) => {
    page.lookFrom([11.57, 48.14], [30, -50, 500], { coordinateSystem: "cartesian" });
    page.lookFrom([11.57, 48.14], [30, -60, 500], {});
  });
  await reached(({ errors }) => errors.length > 0);
  await inPage(() => new Promise((resolve) => setTimeout(resolve, 300)));
  expect(await inPage(({ errors }) => errors)).toEqual(["option"]);
});

it("does not refuse a new view with the layers before it, although the next frame comes late", async () => {
  await inPage((page) => {
    page.answers.length = 0;
    page.lookFrom([11.57, 48.14], [30, -50, 500], {});
    setTimeout(() => {
      page.lookFrom([11.57, 48.14], [30, -50, 500], {
        coordinateSystem: "meter-offsets",
        coordinateOrigin: [11.57, 48.14, 0],
      });
    }, 100);
    // The page is blocked for longer than a refusal has to last.
    requestAnimationFrame(() =>
      requestAnimationFrame(() => {
        const end = performance.now() + 500;
        while (performance.now() < end);
      }),
    );
  });
  await reached(({ answers }) => answers.at(-1)?.answer === "operator");
  expect(await inPage(({ errors }) => errors)).toEqual([]);
});

/** How many points are in one list only: those on the brink, where the conversion rounds. */
function differences(a: number[], b: number[]): number {
  const [inA, inB] = [new Set(a), new Set(b)];
  return a.filter((i) => !inB.has(i)).length + b.filter((i) => !inA.has(i)).length;
}
