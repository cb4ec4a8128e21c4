// The script without a bundler, and its filter for Potree 1.8. No package holds that version of Potree, so the page has a
// viewer of its own with the parts that the filter uses, which draws as Potree does: with WebGL 1, and without an index.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { newPage } from "./browser.js";

let page: Page;
const errors: string[] = [];

interface Filter {
  enabled: boolean;
  readonly settled: boolean;
  readonly answer: string | null;
  readonly visibleCount: number;
  addEventListener(
    type: string,
    listener: (event: { answer: string; viewpoint: number[]; error: Error }) => void,
  ): void;
  dispose(): void;
}
interface Viewer {
  /** Draws a frame from this place, and returns the numbers of the points in the picture. */
  frame(degrees: number): number[];
  /** The number of the point that is picked in the middle of the picture. */
  pick(): number | undefined;
  positions: Float64Array;
  addNode(): void;
  /** What the renderer and the material have of their own. */
  own(): string;
}
declare const HiddenPointRemoval: typeof import("hidden-point-removal") & {
  PotreeFilter: new (viewer: unknown, options?: object) => Filter;
};
declare const makeViewer: () => Viewer;
declare const frame: () => Promise<void>;

const SCRIPT = readFileSync(join(import.meta.dirname, "../../dist/hidden-point-removal.global.js"), "utf8");

beforeAll(async () => {
  page = await newPage({ viewport: { width: 300, height: 300 } });
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.setContent(`<canvas width="300" height="300"></canvas><script>${SCRIPT}</script>`);
  await page.addScriptTag({ path: join(import.meta.dirname, "potree/viewer.js") });
});

afterAll(() => {
  expect(errors).toEqual([]);
});

it("offers the whole package in one file", async () => {
  const count = await page.evaluate(async () => {
    const { init, PointCloud } = HiddenPointRemoval;
    await init();
    return new PointCloud(Float32Array.of(0, 0, 1, 0, 0, 2, 1, 0, 0)).visibleFrom([0, 0, 5]).count;
  });
  expect(count).toBe(2);
});

it("draws and picks what is seen, by maps and at rest, and leaves Potree as it was", async () => {
  const found = await page.evaluate(async () => {
    const viewer = makeViewer();
    const all = viewer.frame(0);
    const before = viewer.own();
    const filter = new HiddenPointRemoval.PotreeFilter(viewer);
    const kinds: string[] = [];
    let viewpoint: number[] = [];
    filter.addEventListener("change", (event) => {
      kinds.push(event.answer);
      viewpoint = event.viewpoint;
    });
    const rest = async (degrees: number) => {
      do {
        viewer.frame(degrees);
        await frame();
      } while (!filter.settled || filter.answer !== "looks");
      return viewer.frame(degrees);
    };
    const drawn = await rest(0);
    const cloud = new HiddenPointRemoval.PointCloud(viewer.positions);
    const exact = (options: object) => new Set(cloud.visibleFrom(viewpoint, options).indices);
    const seen = exact({ looks: 3 });
    const atRest = { drawn: drawn.length, wrong: drawn.filter((i) => !seen.has(i)).length, picked: viewer.pick()! };
    const isSeen = seen.has(atRest.picked);

    let [least, maps] = [all.length, 0];
    for (let degrees = 2; degrees <= 20; degrees += 2) {
      kinds.length = 0;
      for (let tries = 0; kinds.length === 0 && tries < 300; tries++) {
        viewer.frame(degrees);
        await frame();
      }
      maps += Number(kinds[0] === "map");
      least = Math.min(least, viewer.frame(degrees).length);
    }
    // Another node comes while the picture moves.
    const moving = viewer.frame(20);
    viewer.addNode();
    const more = viewer.frame(20);
    const settled = await rest(20);
    filter.enabled = false;
    const shown = viewer.frame(20).length;
    filter.enabled = true;
    filter.dispose();
    return {
      all: all.length,
      atRest,
      isSeen,
      maps,
      least,
      moving: moving.length,
      more: more.length,
      settled: settled.length,
      shown,
      afterwards: viewer.frame(20).length,
      isAsBefore: viewer.own() === before,
    };
  });
  expect(found.atRest.wrong).toBe(0);
  expect(found.isSeen).toBe(true);
  expect(found.maps).toBe(10);
  // Each picture by a map shows about what the settled one does.
  expect(found.atRest.drawn).toBeLessThan(0.6 * found.all);
  expect(found.least).toBeGreaterThan(0.9 * found.atRest.drawn);
  expect(found.moving).toBeLessThan(0.75 * found.all);
  // The node has a quarter as many points as the others. All of them are drawn for less than 1.6 times as many.
  expect(found.more).toBeLessThan(1.3 * found.moving);
  expect(found.settled).toBeLessThan(0.6 * found.shown);
  expect(found.afterwards).toBe(found.shown);
  expect(found.isAsBefore).toBe(true);
});

it("dims, and refuses what is no viewer", async () => {
  const found = await page.evaluate(async () => {
    const viewer = makeViewer();
    const filter = new HiddenPointRemoval.PotreeFilter(viewer, { mode: "dim", exponent: 3 });
    do {
      viewer.frame(0);
      await frame();
    } while (!filter.settled || filter.answer !== "operator");
    const bright = viewer.frame(0).length;
    filter.enabled = false;
    const all = viewer.frame(0).length;
    filter.dispose();
    const codes = [];
    for (const make of [
      () => new HiddenPointRemoval.PotreeFilter({}),
      () => new HiddenPointRemoval.PotreeFilter(viewer, { dimMaterial: {} }),
    ]) {
      try {
        make();
      } catch (error) {
        codes.push((error as { code: string }).code);
      }
    }
    return { bright, all, codes };
  });
  expect(found.bright).toBeGreaterThan(0.2 * found.all);
  expect(found.bright).toBeLessThan(0.7 * found.all);
  expect(found.codes).toEqual(["option", "option"]);
});
