// The hook and the component for React, in a canvas that draws on demand.
import type { Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, expect, it } from "vitest";
import { newPage } from "./browser.js";
import { builtPage } from "./built.js";
import { serveModules } from "./modules.js";
import type { App } from "./react/page.js";

let site: Awaited<ReturnType<typeof serveModules>>;
let path: string;
let page: Page;
let failures: string[];

beforeAll(async () => {
  path = await builtPage("react");
  site = await serveModules({});
});

// A page that stays goes on drawing.
afterEach(() => page.context().close());

afterAll(() => {
  site.close();
});

beforeEach(async () => {
  failures = [];
  page = await newPage();
  page.on("pageerror", (error) => failures.push(String(error)));
  await page.goto(site.address + path);
  await reached(({ points, changes }) => points !== null && changes.length > 0);
});

type Test = (app: App) => boolean;

/** Waits until `test` is true in the page. */
async function reached(test: Test): Promise<void> {
  await page.waitForFunction(`(${test.toString()})(globalThis.app)`);
}

function inPage<T>(look: (app: App) => T): Promise<T> {
  return page.evaluate(`(${look.toString()})(globalThis.app)`);
}

const shown = () => inPage(({ points }) => points!.geometry.drawRange.count);

it("draws the visible points in a frame that it asked for", async () => {
  expect(await shown()).toBe(await inPage(({ changes }) => changes.at(-1)!));
  expect(await shown()).toBeGreaterThanOrEqual(2000);
  expect(await shown()).toBeLessThan(2300);
  // If nothing is new, no more frames are drawn.
  await reached((app) => {
    const known = app as App & { last?: number; since?: number };
    if (known.last !== app.frames) Object.assign(known, { last: app.frames, since: performance.now() });
    return performance.now() - known.since! > 500;
  });
  const before = await inPage(({ frames, changes }) => [frames, changes.length]);
  await inPage(({ state }) => {
    state.camera.position.set(0, 0, -6);
    state.camera.lookAt(0, 0, 0);
    state.invalidate();
  });
  // One frame to ask, another to draw the answer.
  await page.waitForFunction(([frames, changes]) => {
    const { app } = globalThis as unknown as { app: App };
    return app.frames >= frames! + 2 && app.changes.length === changes! + 1;
  }, before);
  expect(
    await inPage(
      ({ points }) =>
        [...(points!.geometry.index!.array as Uint32Array).subarray(0, 1000)].filter((i) => i % 2 === 0).length,
    ),
  ).toBeLessThan(200);
  expect(failures).toEqual([]);
});

it("is frozen, turned off and made anew by its options", async () => {
  const first = await inPage(({ changes }) => changes.length);
  // A new object with the same values.
  const frames = await inPage((app) => app.frames);
  await inPage(({ set }) => {
    set({ exponent: 3, frozen: true });
  });
  // The option takes effect in the frame that it asks for.
  await page.waitForFunction((before) => (globalThis as unknown as { app: App }).app.frames > before, frames);
  await inPage(({ state }) => {
    state.camera.position.set(0, 0, -6);
    state.invalidate();
  });
  await inPage(({ set }) => {
    set({ exponent: 3, frozen: true, enabled: false });
  });
  await reached(({ points }) => points!.geometry.index === null);
  expect(await inPage(({ changes }) => changes.length)).toBe(first);
  await inPage(({ set }) => {
    set({ exponent: 3 });
  });
  await reached(({ points }) => points!.geometry.index !== null);
  await page.waitForFunction((count) => (globalThis as unknown as { app: App }).app.changes.length > count, first);

  await inPage(({ set }) => {
    set({ exponent: 6, mode: "dim" });
  });
  await reached(({ points, changes }) => points!.children.length === 1 && changes.at(-1)! > 3000);
  expect(await shown()).toBeGreaterThan(3000);
  expect(failures).toEqual([]);
});

it("takes up other geometries, and leaves with its points", async () => {
  await inPage(({ setCloud }) => {
    setCloud([0, 0, 1, 0, 0, 0.5, 1, 0, 0]);
  });
  await reached(({ changes }) => changes.at(-1) === 2);
  expect(await shown()).toBe(2);
  await inPage(({ setCloud }) => {
    setCloud(null);
  });
  await reached(({ points }) => points === null);
  await inPage(({ setCloud }) => {
    setCloud([0, 0, 1, 0, 0, 0.5]);
  });
  await reached(({ changes }) => changes.at(-1) === 1);
  expect(failures).toEqual([]);
});

it("reports refusals of answers to onError, and other refusals to the error boundary", async () => {
  await inPage(({ set }) => {
    set({ radius: 0.1 });
  });
  await reached(({ errors }) => errors.length > 0);
  expect(await inPage(({ errors }) => errors)).toEqual(["radius"]);
  await inPage(({ set }) => {
    set({ mode: "fade" as never });
  });
  await reached(({ errors }) => errors.some((error) => error.startsWith("caught: mode")));
});
