import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import { afterEach, describe, expect, it, vi } from "vitest";

import { bumpySphere, freshPackage, problemOf, wasmBytes } from "./support";
import { trappingWasm } from "./trapping-wasm";

const sphere = bumpySphere(1, 500);
const farAway = [0, 0, 5];

afterEach(() => {
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

/** The entry with the wasm in it, and the other entries, on the same fresh page. */
async function freshInline() {
  const others = await freshPackage();
  return { others, inline: await import("hidden-point-removal/inline") };
}

describe("the entry with the wasm embedded", () => {
  it("has the exports of the main entry, and both run the same instance", async () => {
    const { others, inline } = await freshInline();
    const main = await import("hidden-point-removal");
    expect(Object.keys(inline).sort()).toEqual(Object.keys(main).sort());
    await inline.init();
    const answer = inline.hiddenPointRemoval(sphere, farAway);
    expect(answer.count).toBeGreaterThan(10);
    expect(others.hiddenPointRemoval(sphere, farAway)).toEqual(answer);
    expect(inline.PointCloud).toBe(others.PointCloud);
  });

  it("carries exactly the package's wasm", () => {
    const text = readFileSync(new URL("../../src/ts/wasm/embedded.js", import.meta.url), "utf8");
    const [, base64 = ""] = /"([^"]+)"/.exec(text) ?? [];
    expect(gunzipSync(Buffer.from(base64, "base64")).equals(wasmBytes())).toBe(true);
  });

  it("reads and fetches nothing, for itself or for a later worker", async () => {
    const { others, inline } = await freshInline();
    const fetched = vi.fn(() => Promise.reject(new Error("offline")));
    vi.stubGlobal("fetch", fetched);
    const compile = vi.spyOn(WebAssembly, "compile");
    await inline.init();
    const cloud = await others.WorkerPointCloud.create(sphere);
    expect((await cloud.visibleFrom(farAway)).indices).toEqual(inline.hiddenPointRemoval(sphere, farAway).indices);
    await cloud.dispose();
    expect(compile).toHaveBeenCalledTimes(1);
    expect(fetched).not.toHaveBeenCalled();
  });

  it("takes the same inputs as the main entry's init, and starts again after a trap", async () => {
    const { inline } = await freshInline();
    await inline.init(trappingWasm("visibleFrom"));
    const cloud = new inline.PointCloud(sphere);
    expect((await problemOf(() => cloud.visibleFrom(farAway))).code).toBe("internal");
    await inline.init();
    expect(new inline.PointCloud(sphere).visibleFrom(farAway).count).toBeGreaterThan(10);
  });

  it("rejects with the code load if the platform cannot unpack it, and may be called again", async () => {
    const { inline } = await freshInline();
    vi.stubGlobal("DecompressionStream", undefined);
    const problem = await problemOf(() => inline.init());
    expect(problem.code).toBe("load");
    expect(problem.message).toMatch(/embedded wasm/);
    vi.unstubAllGlobals();
    await inline.init();
    expect(inline.hiddenPointRemoval(sphere, farAway).count).toBeGreaterThan(10);
  });
});
