// Arguments that only look valid. Each is answered, or refused with an HprError, and the
// instance lives on.
import { afterEach, describe, expect, it } from "vitest";

import { bumpySphere, expectRefusal, freshPackage, problemOf, readyPackage } from "./support";

const { PointCloud, WorkerPointCloud } = await readyPackage();

const sphere = bumpySphere(1, 500);
const farAway = [0, 0, 5];
const expected = new PointCloud(sphere).visibleFrom(farAway);
const witness = new PointCloud(sphere);
const loose = (value: unknown) => value as never;

function transferredAway<T extends ArrayBufferView>(view: T): T {
  structuredClone(view, { transfer: [view.buffer as ArrayBuffer] });
  return view;
}

afterEach(() => {
  expect(witness.visibleFrom(farAway)).toEqual(expected);
});

describe("an answer", () => {
  it("says so when its indices were transferred away", async () => {
    const answer = witness.visibleFrom(farAway);
    transferredAway(answer.indices);
    await expectRefusal("disposed", /transferred/, () => answer.mask());
    expect(answer.count).toBe(expected.count);
  });
});

describe("a cloud's properties", () => {
  it("cannot be overwritten", async () => {
    const remote = await WorkerPointCloud.create(sphere);
    for (const cloud of [new PointCloud(sphere), remote]) {
      expect(Reflect.set(cloud, "length", 99)).toBe(false);
      expect(Reflect.set(cloud, "skipped", 99)).toBe(false);
      expect([cloud.length, cloud.skipped]).toEqual([500, 0]);
      expect((await cloud.visibleFrom(farAway)).mask()).toHaveLength(500);
      await cloud.dispose();
      // Both name the first wrong argument.
      for (const ask of [() => cloud.visibleFrom([0]), () => cloud.autoRadius([0])]) {
        await expectRefusal("disposed", /disposed/, ask);
      }
    }
  });
});

describe("signals", () => {
  const later = () => new Promise((next) => setTimeout(next, 20));

  it("are refused if they are no signals, and no rejection stays unhandled", async () => {
    const unhandled: unknown[] = [];
    const note = (reason: unknown) => unhandled.push(reason);
    process.on("unhandledRejection", note);
    const half = { aborted: false, addEventListener: null };
    const raising = {
      aborted: false,
      addEventListener: () => {
        throw new RangeError("mine");
      },
      removeEventListener: () => undefined,
    };
    const remote = await WorkerPointCloud.create(sphere);
    for (const signal of [{}, half, { aborted: false, addEventListener: () => undefined }, null]) {
      await expectRefusal("option", /signal/, () => WorkerPointCloud.create(sphere, { signal: loose(signal) }));
      await expectRefusal("option", /signal/, () => remote.visibleFrom(farAway, { signal: loose(signal) }));
    }
    expect(await problemOf(() => WorkerPointCloud.create(sphere, { signal: loose(raising) }))).toBeInstanceOf(
      RangeError,
    );
    expect(await problemOf(() => remote.visibleFrom(farAway, { radius: 1, signal: loose(raising) }))).toBeInstanceOf(
      RangeError,
    );
    expect((await remote.visibleFrom(farAway)).count).toBe(expected.count);
    await remote.dispose();
    await later();
    process.off("unhandledRejection", note);
    expect(unhandled).toEqual([]);
  });
});

describe("init, called with another input while it is starting,", () => {
  it("tries the new input after the first has failed", async () => {
    const fresh = await freshPackage();
    const bytes = new Uint8Array(3);
    const outcomes = await Promise.allSettled([
      fresh.init(bytes),
      fresh.init(bytes),
      fresh.init("/nowhere.wasm"),
      fresh.init(),
    ]);
    expect(outcomes.map(({ status }) => status)).toEqual(["rejected", "rejected", "rejected", "fulfilled"]);
    const [first, second, third] = outcomes.map((one) =>
      one.status === "rejected" ? (one.reason as Error).message : "",
    );
    expect(second).toBe(first);
    expect(third).toContain("/nowhere.wasm");
    expect(fresh.hiddenPointRemoval(sphere, farAway)).toEqual(expected);
  });
});

describe("messages", () => {
  it.each<[RegExp, () => unknown]>([
    [/from the given Response:/, () => new Response(new Uint8Array(3))],
    [/from an empty address:/, () => ""],
  ])("name the file that was to be loaded: %s", async (names, input) => {
    const fresh = await freshPackage();
    expect((await problemOf(() => fresh.init(input() as never))).message).toMatch(names);
  });
});
