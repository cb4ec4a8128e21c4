// Octrees that are read node by node: `hidden-point-removal/stream`.
import { execFile } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { join } from "node:path";
import { promisify } from "node:util";
import type { Octree, OctreeStep, OctreeViewOptions, PotreeFiles } from "hidden-point-removal/stream";
import { describe, expect, it, vi } from "vitest";

import { georeferencedBall, rows } from "../browser/clouds";
import { colorOf, inMillimeters } from "../browser/formats";
import { countedRanges, potreeOctree, type PotreeOctree, room, town } from "./octrees";
import { blocks, promised, root, scratchFor } from "./snippets";
import { randomNumbers, readyPackage } from "./support";

const { HprError, PointCloud } = await readyPackage();
// Only now: an earlier import would be another instance of the package.
const { openOctree } = await import("hidden-point-removal/stream");

const files = potreeOctree(town(40_000, randomNumbers(1)), { leaf: 400, grid: 10 });
const whole = new PointCloud(files.positions);
const exponential = { inversion: { exponential: 0.03 } } as const;
const STREET = [50.3, 12.4, 1.7];
const ABOVE = [50, 50, 300];

function readersOf(of: PotreeOctree): { files: PotreeFiles; asked: [number, number][] } {
  const octree = countedRanges(of.octree);
  const files = { metadata: of.metadata, hierarchy: countedRanges(of.hierarchy).read, octree: octree.read };
  return { files, asked: octree.asked };
}

const opened = (of = files) => openOctree(readersOf(of).files);

async function stepsOf(octree: Octree, viewpoint: number[], options: OctreeViewOptions = {}): Promise<OctreeStep[]> {
  const steps: OctreeStep[] = [];
  for await (const step of octree.visibleFrom(viewpoint, options)) steps.push(step);
  return steps;
}

const lastOf = async (octree: Octree, viewpoint: number[], options?: OctreeViewOptions) =>
  (await stepsOf(octree, viewpoint, options)).at(-1)!;

/** The visible points of a step as indices of the whole cloud. */
function indicesOf(step: OctreeStep, of = files): Uint32Array {
  const all = step.visible.flatMap(({ key, indices }) => [...indices].map((i) => of.nodes.get(key)!.first + i));
  return Uint32Array.from(all).sort();
}

/** The code and the message of the error that ends a promise. */
async function refusal(call: () => Promise<unknown>): Promise<[code: string, message: string]> {
  try {
    await call();
  } catch (error) {
    return error instanceof HprError ? [error.code, error.message] : [(error as Error).name, String(error)];
  }
  return ["none", "nothing was thrown"];
}

describe("the last step", () => {
  it.each([
    ["on a street", STREET],
    ["above", ABOVE],
    ["in the plane of walls", [2.5, -30, 5]],
    ["outside", [-60, -80, 40]],
    ["on a point", [...files.positions.subarray(3000, 3003)]],
  ])("shows exactly what the whole cloud shows: %s", async (_, viewpoint) => {
    const octree = await opened();
    for (const options of [exponential, { radius: 40_000 }, { radius: 1000, inversion: { power: 2 } }] as const) {
      const last = await lastOf(octree, viewpoint, options);
      const expected = whole.visibleFrom(viewpoint, options);
      expect([last.exact, last.nodes.undecided]).toEqual([true, 0]);
      expect(indicesOf(last)).toEqual(expected.indices);
      expect([last.count, last.radius, last.inversion]).toEqual([expected.count, expected.radius, expected.inversion]);
      expect(last.positions()).toHaveLength(3 * expected.count);
    }
  });

  it("is exact inside of a room, far from the origin, with equal points and points in one plane", async () => {
    const far = room(20_000, randomNumbers(2)).map((value, i) => value + [512_000, 5_403_000, 400][i % 3]!);
    const doubled = Float64Array.from([...far, ...far.subarray(0, 9000)]);
    const flat = far.map((value, i) => (i % 3 === 2 ? 400 : value));
    for (const [points, viewpoint] of [
      [doubled, [512_004, 5_403_003, 401.6]],
      [doubled, [512_004, 5_403_003, 400]],
      [flat, [512_004, 5_403_003, 400]],
      [flat, [512_004, 5_403_003, 402]],
    ] as const) {
      const tree = potreeOctree(points, { leaf: 300, scale: 0.0001 });
      const last = await lastOf(await opened(tree), [...viewpoint], exponential);
      const expected = new PointCloud(tree.positions).visibleFrom(viewpoint, exponential);
      expect([last.exact, indicesOf(last, tree)]).toEqual([true, expected.indices]);
    }
  });

  it("answers an octree of one point, and one without points", async () => {
    const one = await lastOf(await opened(potreeOctree([1, 2, 3])), [0, 0, 0]);
    expect([one.exact, one.count, [...one.positions()]]).toEqual([true, 1, [1, 2, 3]]);
    const metadata = { ...files.metadata, points: 0, hierarchy: { firstChunkSize: 22 } };
    const nothing = { metadata, hierarchy: countedRanges(new Uint8Array(22)).read, octree: countedRanges(new Uint8Array(0)).read }; // prettier-ignore
    const none = await openOctree(nothing);
    const last = await lastOf(none, [0, 0, 0]);
    expect([last.exact, last.count, last.nodes]).toEqual([true, 0, { read: 1, hidden: 0, undecided: 0 }]);
  });

  it("uses the scale c of the whole cloud, estimated within 2 %, and records it", async () => {
    const octree = await opened();
    const spacing = await octree.spacing();
    expect(spacing / whole.spacing).toBeGreaterThan(0.98);
    expect(spacing / whole.spacing).toBeLessThan(1.02);
    const last = await lastOf(octree, STREET);
    const c = (last.inversion as { exponential: number }).exponential;
    const automatic = whole.visibleFrom(STREET, { inversion: { exponential: "auto" } }).inversion;
    expect(c / (automatic as { exponential: number }).exponential).toBeCloseTo(spacing / whole.spacing, 12);
    expect(indicesOf(last)).toEqual(whole.visibleFrom(STREET, { inversion: last.inversion }).indices);
    // A view before it changes nothing.
    const other = await opened();
    await lastOf(other, STREET, exponential);
    expect(await other.spacing()).toBe(spacing);
  });
});

describe("the steps", () => {
  it("begin with the root at once, and never show a point again that they have hidden", async () => {
    const octree = await opened();
    for (const viewpoint of [STREET, ABOVE]) {
      const steps = await stepsOf(octree, viewpoint, exponential);
      expect(steps.length).toBeGreaterThan(1);
      expect(steps[0]!.visible.map(({ key }) => key)).toEqual(["r"]);
      expect(steps.map(({ exact }) => exact)).toEqual(steps.map((_, i) => i === steps.length - 1));
      const shown = steps.map((step) => new Set(indicesOf(step)));
      for (let i = 1; i < steps.length; i++) {
        const [before, after] = [steps[i - 1]!, steps[i]!];
        const nodes = new Set(before.visible.map(({ key }) => key));
        for (const { key, indices } of after.visible) {
          if (!nodes.has(key)) continue;
          const { first } = files.nodes.get(key)!;
          expect([...indices].every((index) => shown[i - 1]!.has(first + index))).toBe(true);
        }
        expect(after.points).toBeGreaterThanOrEqual(before.points);
      }
    }
  });

  it("never fetch a node that the nodes before it hide, nor the nodes below it", async () => {
    const { files: readers, asked } = readersOf(files);
    const octree = await openOctree(readers);
    const last = await lastOf(octree, STREET, exponential);
    expect(last.nodes.hidden).toBeGreaterThan(20);
    expect(asked).toHaveLength(last.nodes.read);
    expect(last.bytes).toBe(asked.reduce((sum, [from, to]) => sum + to - from, 0));
    const fetched = new Set(asked.map(([from]) => from));
    const left = [...files.nodes].filter(([, { offset }]) => !fetched.has(offset));
    expect(left.reduce((sum, [, { count }]) => sum + count, 0)).toBe(40_000 - last.points);
    // Every node that was not fetched is below one that was not fetched, and has no visible point.
    const { indices } = whole.visibleFrom(STREET, exponential);
    const keys = new Set(left.map(([key]) => key));
    for (const [key, { first, count }] of files.nodes) {
      if (!keys.has(key)) continue;
      const below = [...files.nodes.keys()].filter((other) => other.startsWith(key));
      expect(below.every((other) => keys.has(other))).toBe(true);
      expect(indices.some((index) => index >= first && index < first + count)).toBe(false);
    }
  });

  it("stay within the budget, and say how many nodes are undecided", async () => {
    const octree = await opened();
    const all = whole.visibleFrom(ABOVE, exponential).count;
    for (const budget of [1, 3000, 20_000, all]) {
      const steps = await stepsOf(octree, ABOVE, { ...exponential, budget });
      const last = steps.at(-1)!;
      expect(Math.max(...steps.map(({ count }) => count))).toBeLessThanOrEqual(budget);
      expect([last.exact, last.nodes.undecided > 0]).toEqual([false, true]);
      expect(last.nodes.read + last.nodes.hidden + last.nodes.undecided).toBeLessThanOrEqual(files.nodes.size);
      if (budget > 1) expect(last.count).toBeGreaterThan(0);
    }
    const enough = await lastOf(octree, ABOVE, { ...exponential, budget: 41_000 });
    expect([enough.exact, enough.count]).toEqual([true, all]);
  });

  it("are the same with one request at a time and with many", async () => {
    const octree = await opened();
    const expected = indicesOf(await lastOf(octree, STREET, exponential));
    for (const requests of [1, 40]) {
      expect(indicesOf(await lastOf(octree, STREET, { ...exponential, requests }))).toEqual(expected);
    }
  });

  it("end by the signal, and when the caller stops", async () => {
    const { files: readers, asked } = readersOf(files);
    const octree = await openOctree(readers);
    const controller = new AbortController();
    const progress: number[] = [];
    const options = { ...exponential, signal: controller.signal, onProgress: ({ read }: { read: number }) => { progress.push(read); if (read === 9) controller.abort(); } }; // prettier-ignore
    expect((await refusal(() => stepsOf(octree, ABOVE, options)))[0]).toBe("AbortError");
    expect(progress).toEqual([1, 2, 3, 4, 5, 6, 7, 8, 9]);
    expect((await refusal(() => stepsOf(octree, ABOVE, options)))[0]).toBe("AbortError");
    expect((await refusal(() => stepsOf(octree, ABOVE, { signal: AbortSignal.abort() })))[0]).toBe("AbortError");
    const before = asked.length;
    for await (const step of octree.visibleFrom(ABOVE, exponential)) {
      expect(step.exact).toBe(false);
      break;
    }
    expect(asked.length).toBeLessThan(before + 9);
  });
});

describe("the coarsest levels", () => {
  it("are whole ones, as many as the limit allows, and the first one always", async () => {
    const octree = await opened();
    const counts = new Map<number, number>();
    for (const [key, { count }] of files.nodes) {
      counts.set(key.length, (counts.get(key.length) ?? 0) + count);
    }
    const levels = [...counts].sort(([a], [b]) => a - b).map(([, count]) => count);
    let sum = 0;
    for (const count of levels) {
      sum += count;
      expect((await octree.coarse(sum)).positions).toHaveLength(3 * sum);
    }
    expect(sum).toBe(octree.points);
    expect((await octree.coarse(1)).positions).toHaveLength(3 * levels[0]!);
    expect((await octree.coarse(levels[0]! + levels[1]! - 1)).positions).toHaveLength(3 * levels[0]!);
  });
});

describe("another viewpoint", () => {
  it("reads no node again that is kept", async () => {
    const { files: readers, asked } = readersOf(files);
    const octree = await openOctree(readers);
    const first = await lastOf(octree, STREET, exponential);
    const next = await lastOf(octree, [50.8, 12.9, 1.7], exponential);
    expect(next.exact).toBe(true);
    expect(next.bytes).toBeLessThan(first.bytes / 10);
    expect(new Set(asked.map(([from]) => from)).size).toBe(asked.length);
    expect(octree.cached).toBe(asked.reduce((sum, [from, to]) => sum + (to - from) / 13, 0));
    // A view that goes on after the end keeps nothing, either.
    const running = octree.visibleFrom(ABOVE, exponential);
    await running.next();
    octree.dispose();
    expect(octree.cached).toBe(0);
    expect((await running.next()).done).toBe(false);
    expect(octree.cached).toBe(0);
    expect((await refusal(() => stepsOf(octree, STREET)))[0]).toBe("disposed");
    expect((await refusal(() => octree.spacing()))[0]).toBe("disposed");
  });

  it("finds no more nodes than the cache may keep", async () => {
    const { files: readers, asked } = readersOf(files);
    const octree = await openOctree(readers, { cache: 5000 });
    await lastOf(octree, STREET, exponential);
    expect(octree.cached).toBeLessThanOrEqual(5000);
    const once = asked.length;
    const again = await lastOf(octree, STREET, exponential);
    expect(asked.length).toBeGreaterThan(1.5 * once);
    expect(again.exact).toBe(true);
  });
});

describe("colors", () => {
  // As they come out of the files.
  const points = potreeOctree(town(5000, randomNumbers(4))).positions;
  /** A color for each place, with 16 bits. */
  const colorAt = (x: number, y: number, z: number) => [x, y, z].map((value) => Math.round(1000 * value) & 0xffff);
  const colored = potreeOctree(points, {
    leaf: 200,
    grid: 10,
    colors: Uint16Array.from(rows(points).flatMap(([x, y, z]) => colorAt(x!, y!, z!))),
  });

  it("come with the visible points of each step, when they are asked for", async () => {
    const octree = await openOctree(readersOf(colored).files, { colors: true, cache: 1000 });
    const steps = await stepsOf(octree, STREET, exponential);
    expect(steps.length).toBeGreaterThan(1);
    for (const step of steps) {
      const expected = rows(step.positions()).flatMap(([x, y, z]) => colorAt(x!, y!, z!));
      expect([...step.colors()!]).toEqual(expected);
      expect(step.visible.flatMap(({ colors }) => [...colors!])).toEqual(expected);
    }
    const plain = await lastOf(await openOctree(readersOf(colored).files), STREET, exponential);
    expect(plain.colors()).toBeUndefined();
    expect(plain.positions()).toEqual(steps.at(-1)!.positions());
  });

  it("are missing if the octree has none", async () => {
    const last = await lastOf(await openOctree(readersOf(files).files, { colors: true }), STREET, exponential);
    expect([last.colors(), last.visible[0]!.colors]).toEqual([undefined, undefined]);
  });

  it("are read from COPC", async () => {
    const bytes = new Uint8Array(readFileSync(join(root, "tests/browser/fixtures/octree.copc.laz")));
    const octree = await openOctree(countedRanges(bytes).read, { colors: true });
    const last = await lastOf(octree, [512_345, 5_403_222.3, 431.6], exponential);
    const index = new Map(rows(inMillimeters(georeferencedBall(3000))).map((place, i) => [place.join(), i]));
    expect([...last.colors()!]).toEqual(
      rows(last.positions()).flatMap((place) => colorOf(index.get(place.join())!).map((value) => 257 * value)),
    );
  });

  it("are true or false", async () => {
    const call = () => openOctree(readersOf(files).files, { colors: "yes" as never });
    expect(await refusal(call)).toEqual(["option", expect.stringMatching(/colors must be true or false, got "yes"/)]);
  });
});

it("says what to install if the package copc is missing", async () => {
  vi.doMock("copc", () => {
    throw new Error("no such package");
  });
  const [code, message] = await refusal(() => openOctree(new Blob([new Uint8Array(9)])));
  vi.doUnmock("copc");
  expect([code, message]).toEqual(["load", expect.stringMatching(/COPC needs the package copc: npm install copc \(/)]);
});

describe("a broken octree of Potree is refused", () => {
  const small = potreeOctree(town(3000, randomNumbers(3)), { leaf: 200 });
  const changed = (change: (copy: PotreeOctree) => void) => {
    const copy = { ...small, metadata: structuredClone(small.metadata), hierarchy: small.hierarchy.slice(), octree: small.octree.slice() }; // prettier-ignore
    change(copy);
    return copy;
  };
  const view = (bytes: Uint8Array) => new DataView(bytes.buffer, bytes.byteOffset);
  it.each<[string, (copy: PotreeOctree) => void, RegExp]>([
    ["a wrong number of points", ({ hierarchy }) => { view(hierarchy).setUint32(2, 7, true); }, /node r is listed with 7 points, but has \d+ bytes/],
    ["more points than its header gives", ({ metadata }) => { metadata["points"] = 100; }, /list more points than the 100 of its header/],
    ["no points by its header", ({ metadata }) => { metadata["points"] = 0; }, /list more points than the 0 of its header/],
    ["fewer points than its header gives", ({ metadata }) => { metadata["points"] = 3001; }, /its nodes list 3000 points, but its header gives 3001/],
    ["a node of an unknown type", ({ hierarchy }) => { view(hierarchy).setUint8(22, 9); }, /node r\d is listed with the unknown type 9/],
    ["a point outside of its node", ({ octree }) => { view(octree).setInt32(13 * 5, 2 ** 30, true); }, /point 5 of node r lies outside/],
    ["a cut file", (copy) => { copy.octree = copy.octree.subarray(0, 1000); }, /it may be cut off/],
    ["a cut list of nodes", (copy) => { copy.hierarchy = copy.hierarchy.subarray(0, 30); }, /it may be cut off/],
    ["a page that is too short", ({ metadata }) => { metadata["hierarchy"] = { firstChunkSize: 44 }; }, /ends before node/],
    ["a page that is too long", ({ hierarchy }) => { view(hierarchy).setUint8(1, 0); }, /bytes for 1 nodes/],
    ["a page that contains itself", ({ hierarchy }) => { for (let at = 22; at < hierarchy.length; at += 22) if (hierarchy[at] === 2) { view(hierarchy).setBigInt64(at + 6, 0n, true); } }, /contains itself/],
    ["a part of no length", ({ hierarchy }) => { view(hierarchy).setBigInt64(6, -4n, true); }, /a part of \d+ bytes at byte -4/],
    ["compressed points", ({ metadata }) => { metadata["encoding"] = "BROTLI"; }, /compressed \(BROTLI\); convert it/],
    ["another version", ({ metadata }) => { metadata["version"] = "1.8"; }, /version 2/],
    ["no positions", ({ metadata }) => { metadata["attributes"] = [{ name: "rgb", type: "uint16", size: 6 }]; }, /no attribute position/],
    ["an attribute without a size", ({ metadata }) => { metadata["attributes"] = [{ name: "rgb" }]; }, /"rgb" has no size/],
    ["no attributes", ({ metadata }) => { delete metadata["attributes"]; }, /points or attributes is missing/],
    ["no scale", ({ metadata }) => { delete metadata["scale"]; }, /scale, offset, boundingBox or hierarchy is missing/],
    ["a scale of 0", ({ metadata }) => { metadata["scale"] = [0, 1, 1]; }, /scale.*is not a finite number/],
  ])("%s", async (_, change, message) => {
    const call = async () => lastOf(await opened(changed(change)), ABOVE, exponential);
    expect(await refusal(call)).toEqual(["load", expect.stringMatching(message)]);
  }); // prettier-ignore
});

describe("COPC", () => {
  const bytes = new Uint8Array(readFileSync(join(root, "tests/browser/fixtures/octree.copc.laz")));
  const center = [512_345, 5_403_210.3, 431.6];
  const view = (copy: Uint8Array) => new DataView(copy.buffer, copy.byteOffset);
  const from = (copy: Uint8Array) => openOctree(countedRanges(copy).read);
  /** The places of the entries of nodes in the list of nodes: 32 bytes for each. */
  const entries = (copy: Uint8Array) => {
    const found: number[] = [];
    for (let at = 45_398 + 60; at + 32 <= copy.length; at += 4) {
      const [depth, count] = [view(copy).getInt32(at, true), view(copy).getInt32(at + 28, true)];
      if (depth === 0 && count === 500) found.push(at);
    }
    return found;
  };

  it("is exact, from ranges, from a Blob, and through fetch", async () => {
    // With so small a scale, nothing hides anything: these are all points of the file.
    const cloudPositions = (await lastOf(await from(bytes), center, { inversion: { exponential: 1e-9 } })).positions();
    const cloud = new PointCloud(cloudPositions);
    expect(cloud.length).toBe(3000);
    const asked: string[] = [];
    const fetcher = (url: string, init?: RequestInit) => {
      const range = new Headers(init?.headers).get("range")!;
      asked.push(`${url} ${range}`);
      const [first, last] = range.slice("bytes=".length).split("-").map(Number) as [number, number];
      return Promise.resolve(new Response(bytes.slice(first, last + 1), { status: 206 }));
    };
    const octrees = [
      await openOctree(new Blob([bytes])),
      await openOctree("https://example.org/a.copc.laz?key=1", { fetch: fetcher }),
      await openOctree(new URL("https://example.org/b.laz"), { fetch: fetcher, wasm: new URL(import.meta.resolve("hidden-point-removal/files.wasm")) }),
    ]; // prettier-ignore
    for (const octree of octrees) {
      expect(octree.points).toBe(3000);
      const viewpoint = center.map((x, i) => x + (i === 1 ? 12 : 0));
      const last = await lastOf(octree, viewpoint, exponential);
      expect(last.exact).toBe(true);
      expect(last.nodes.read + last.nodes.hidden).toBeGreaterThan(9);
      const { indices } = cloud.visibleFrom(viewpoint, exponential);
      expect(indices.length).toBeLessThan(2000);
      const sorted = (list: number[]) => list.map(String).sort();
      const all = [...cloudPositions];
      expect(sorted([...last.positions()])).toEqual(sorted([...indices].flatMap((i) => all.slice(3 * i, 3 * i + 3))));
    }
    expect(asked.some((line) => line.startsWith("https://example.org/a.copc.laz?key=1 bytes="))).toBe(true);
  });

  it("is refused if it is broken", async () => {
    const changed = (change: (copy: Uint8Array) => void) => {
      const copy = bytes.slice();
      change(copy);
      return copy;
    };
    const [entry] = entries(bytes) as [number];
    expect(entries(bytes)).toHaveLength(1);
    const cases: [Uint8Array, RegExp][] = [
      [changed((copy) => { view(copy).setInt32(entry + 28, 400, true); }), /header gives|is listed with 400 points, but holds 500/],
      [changed((copy) => { view(copy).setInt32(entry + 24, 3000, true); }), /is listed with 3000 bytes, but holds 3512/],
      [changed((copy) => { view(copy).setInt32(entry + 24, 20, true); }), /too few for a chunk/],
      [changed((copy) => { view(copy).setInt32(entry + 24, -1, true); }), /a part of -1 bytes/],
      [changed((copy) => { view(copy).setInt32(entry, 9, true); }), /does not list it/],
      [changed((copy) => { view(copy).setInt32(entry + 36, 5, true); }), /lists a node that is not below it/],
      [changed((copy) => { view(copy).setInt32(1023, 2 ** 30, true); }), /lies outside of the node's box/],
      [bytes.subarray(0, 46_000), /is broken/],
      [bytes.subarray(0, 300), /not a COPC file/],
      [changed((copy) => { copy.set([0x58], 0); }), /not a COPC file/],
    ]; // prettier-ignore
    for (const [copy, message] of cases) {
      expect(await refusal(async () => lastOf(await from(copy), center, exponential))).toEqual([
        "load",
        expect.stringMatching(message),
      ]);
    }
  });

  it("is refused if a node is cut off", async () => {
    const cut = (from: number, to: number) => Promise.resolve(bytes.subarray(from, to - from === 3512 ? to - 9 : to));
    const call = async () => lastOf(await openOctree(cut), center, exponential);
    expect(await refusal(call)).toEqual(["load", expect.stringMatching(/3503 of the 3512 bytes .* cut off/)]);
  });

  it("says what a server refuses", async () => {
    const answering = (status: number) => ({ fetch: () => Promise.resolve(new Response("all of it", { status })) });
    const open = (options: object) => refusal(() => openOctree("https://example.org/a.laz", options));
    expect(await open(answering(200))).toEqual(["load", expect.stringMatching(/does not answer range requests/)]);
    expect(await open(answering(404))).toEqual(["load", expect.stringMatching(/server answered 404/)]);
    const silent = { fetch: () => Promise.reject(new TypeError("no network")), retries: 0 };
    expect(await open(silent)).toEqual(["load", expect.stringMatching(/could not be fetched: no network/)]);
    const text = await refusal(() => openOctree("https://example.org/metadata.json", answering(200)));
    expect(text).toEqual(["load", expect.stringMatching(/is not a JSON file/)]);
  });
});

it("runs the snippet of the documentation", async () => {
  const bytes = readFileSync(join(root, "tests/browser/fixtures/octree.copc.laz"));
  const server = createServer(({ headers }, response) => {
    const [first, last] = headers.range!.slice("bytes=".length).split("-").map(Number) as [number, number];
    response.writeHead(206).end(bytes.subarray(first, last + 1));
  });
  await new Promise<void>((listening) => server.listen(0, "127.0.0.1", listening));
  const address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/ball.copc.laz`;
  const [code = ""] = blocks("docs/STREAM.md", "js");
  const file = join(scratchFor("stream"), "snippet.mjs");
  writeFileSync(file, code.replace("https://example.org/ball.copc.laz", address));
  const { stdout } = await promisify(execFile)(process.execPath, [file]);
  server.close();
  expect(stdout.trim().split("\n")).toEqual(promised(code));
});

it("reads the files of Potree beside their metadata", async () => {
  const asked: string[] = [];
  const served = { "hierarchy.bin": files.hierarchy, "octree.bin": files.octree } as Record<string, Uint8Array>;
  const fetcher = (url: string, init?: RequestInit) => {
    const { pathname, search } = new URL(url);
    asked.push(pathname + search);
    if (pathname.endsWith(".json")) return Promise.resolve(Response.json(files.metadata));
    const [first, last] = new Headers(init?.headers).get("range")!.slice("bytes=".length).split("-").map(Number);
    const part = served[pathname.split("/").at(-1)!]!.slice(first, last! + 1);
    return Promise.resolve(new Response(part, { status: 206 }));
  };
  const octree = await openOctree("https://example.org/town/metadata.json?key=1", { fetch: fetcher });
  expect(octree.points).toBe(40_000);
  expect(octree.bounds.min).toEqual(files.metadata["offset"]);
  const last = await lastOf(octree, STREET, exponential);
  expect(indicesOf(last)).toEqual(whole.visibleFrom(STREET, exponential).indices);
  expect(new Set(asked)).toEqual(
    new Set(["/town/metadata.json?key=1", "/town/hierarchy.bin?key=1", "/town/octree.bin?key=1"]),
  );
});

it("refuses bad arguments before anything is read", async () => {
  const loose = (value: unknown) => value as never;
  const octree = await opened();
  const options: [object, string][] = [
    [{ budget: 0 }, "option"],
    [{ requests: 1.5 }, "option"],
    [{ exponent: 2 }, "option"],
    [{ signal: 3 }, "option"],
    [{ onProgress: 3 }, "option"],
    [{ radius: -1 }, "radius"],
    [{ radius: "auto" }, "option"],
    [{ radius: 5, inversion: { exponential: "auto" } }, "option"],
    [{ inversion: { power: 99 } }, "option"],
    [{ radius: 9, inversion: { power: 99 } }, "option"],
  ];
  for (const [given, code] of options) {
    expect([given, (await refusal(() => stepsOf(octree, STREET, loose(given))))[0]]).toEqual([given, code]);
  }
  expect((await refusal(() => stepsOf(octree, [0, 0])))[0]).toBe("viewpoint");
  expect((await refusal(() => stepsOf(octree, [0, 0, NaN])))[0]).toBe("viewpoint");
  expect((await refusal(() => stepsOf(octree, STREET, { radius: 10 })))[0]).toBe("radius");
  const attributes = { ...readersOf(files).files, metadata: { ...files.metadata, attributes: [null] } };
  for (const source of [3, null, "http://[", { metadata: {} }, attributes]) {
    expect((await refusal(() => openOctree(loose(source))))[0]).toBe("option");
  }
  for (const given of [{ fetch: 3 }, { lazPerf: {} }, { cache: -1 }, { cash: 1 }]) {
    expect((await refusal(() => openOctree(readersOf(files).files, loose(given))))[0]).toBe("option");
  }
});
