// The maps by which the page draws its frames, as the graphics card gets them.
import { VisibilityMap, type VisibilityOptions } from "hidden-point-removal";
import type { Page } from "playwright-core";
import { expect } from "vitest";
import { bounds } from "../bench/views.js";
import { inNode } from "./support.js";

interface DrawnMap {
  /** As the status says it in this frame. */
  viewpoint: number[];
  given: Record<"hprEye" | "hprMargins", number[]>;
  depths: Float32Array;
}

declare const drawnMaps: DrawnMap[];

/** Keeps each map that is drawn. To be called before the page is opened. */
export function keepMaps(page: Page): Promise<unknown> {
  return page.addInitScript(() => {
    const names = new WeakMap<object, string>();
    const given: Record<string, number[]> = {};
    let depths: Float32Array | undefined;
    const maps: unknown[] = [];
    const after = (method: string, watch: (parameters: unknown[], result: unknown) => void) => {
      const own = Reflect.get(WebGL2RenderingContext.prototype, method) as (...parameters: unknown[]) => unknown;
      Reflect.set(WebGL2RenderingContext.prototype, method, function (this: unknown, ...parameters: unknown[]) {
        const result = own.apply(this, parameters);
        watch(parameters, result);
        return result;
      });
    };
    after("getUniformLocation", ([, name], location) => {
      if (location) names.set(location, name as string);
    });
    for (const method of ["uniform1f", "uniform3f", "uniform4f"]) {
      after(method, ([location, ...numbers]) => {
        given[names.get(location as object) ?? ""] = numbers as number[];
      });
    }
    after("texSubImage2D", (parameters) => {
      if (parameters.at(-1) instanceof Float32Array) depths = (parameters.at(-1) as Float32Array).slice();
    });
    after("drawArrays", () => {
      if (given["hprMode"]?.[0] !== 1 || depths === undefined) return;
      const { viewpoint } = document.getElementById("status")!.dataset;
      maps.push({ viewpoint: viewpoint!.split(",").map(Number), given: { ...given }, depths });
      depths = undefined;
    });
    Object.assign(globalThis, { drawnMaps: maps });
  });
}

/** What the maps that were drawn since the last call hide, beside the answers of the package in Node. */
export async function judgeMaps(page: Page, positions: Float32Array, options: VisibilityOptions = {}) {
  const maps = await page.evaluate(() => drawnMaps.splice(0));
  const { center } = bounds({ positions });
  const judged = [];
  for (const { viewpoint, given, depths } of maps) {
    const map = mapOf({ data: depths, viewpoint, center, origin: center, numbers: given.hprMargins });
    expect(map.uniforms).toEqual({ hprViewpoint: given.hprEye.map(Math.fround), hprMargins: given.hprMargins });
    const visible = await inNode(positions, (cloud) => cloud.visibleFrom(viewpoint, options).mask());
    const counts = { hidden: 0, visible: 0, wrong: 0, found: 0 };
    map.hides(positions).forEach((hidden, i) => {
      counts[visible[i] === 1 ? "visible" : "hidden"]++;
      if (hidden === 1) counts[visible[i] === 1 ? "wrong" : "found"]++;
    });
    judged.push({ wrong: counts.wrong / counts.visible, found: counts.found / counts.hidden });
  }
  return judged;
}

/** A map of what was drawn. The package makes maps of answers alone. */
function mapOf(answer: object): VisibilityMap {
  return new (VisibilityMap as unknown as new (answer: object) => VisibilityMap)(answer);
}
