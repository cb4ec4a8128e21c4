// Arguments that only look valid. Each is answered, or refused with an HprError, and the
// instance lives on.
import { runInNewContext } from "node:vm";
import { afterEach, describe, expect, it } from "vitest";

import { bumpySphere, freshPackage, problemOf, readyPackage } from "./support";

const { PointCloud, WorkerPointCloud, hiddenPointRemoval, HprError } = await readyPackage();

const sphere = bumpySphere(1, 500);
const farAway = [0, 0, 5];
const expected = new PointCloud(sphere).visibleFrom(farAway);
const witness = new PointCloud(sphere);
const loose = (value: unknown) => value as never;

/** A getter or method that a test adds to an object, whatever its type. */
function withOwn<T extends object>(target: T, name: PropertyKey, descriptor: PropertyDescriptor): T {
  return Object.defineProperty(target, name, { configurable: true, ...descriptor });
}

function transferredAway<T extends ArrayBufferView>(view: T): T {
  structuredClone(view, { transfer: [view.buffer as ArrayBuffer] });
  return view;
}

async function expectRefusal(code: string, names: RegExp, call: () => unknown) {
  const problem = await problemOf(call);
  expect(problem).toBeInstanceOf(HprError);
  expect(problem.code).toBe(code);
  expect(problem.message).toMatch(names);
}

afterEach(() => {
  expect(witness.visibleFrom(farAway)).toEqual(expected);
});

describe("positions whose memory is gone", () => {
  class Resizable extends ArrayBuffer {
    declare resize: (length: number) => void;
  }
  const cutOff = () => {
    const buffer = new (ArrayBuffer as unknown as new (length: number, options: object) => Resizable)(72, {
      maxByteLength: 72,
    });
    const view = new Float32Array(buffer, 36, 9);
    buffer.resize(40);
    return view;
  };
  it.each<[string, () => Float32Array | Float64Array]>([
    ["a transferred Float32Array", () => transferredAway(new Float32Array(9))],
    ["a transferred Float64Array", () => transferredAway(new Float64Array(9))],
    ["a view of a part that its buffer has lost", cutOff],
  ])("are refused: %s", async (_, positions) => {
    await expectRefusal("positions-type", /gone/, () => new PointCloud(positions()));
    await expectRefusal("positions-type", /gone/, () => new PointCloud(positions(), { stride: 9 }));
    await expectRefusal("positions-type", /gone/, () => WorkerPointCloud.create(positions()));
    await expectRefusal("positions-type", /gone/, () => WorkerPointCloud.create(positions(), { transfer: true }));
  });
});

describe("typed arrays of a class of their own", () => {
  class CountsPoints extends Float32Array {
    constructor(points: number) {
      super(points * 3);
    }
  }
  class OtherSpecies extends Float32Array {
    static get [Symbol.species]() {
      return Float64Array as unknown as Float32ArrayConstructor;
    }
  }
  class OwnTag extends Float32Array {
    override get [Symbol.toStringTag]() {
      return "Points" as never;
    }
  }
  const filled = <T extends Float32Array>(array: T) => {
    array.set(sphere);
    return array;
  };
  const plain = () => sphere.slice();
  const arrays: [name: string, make: () => Float32Array][] = [
    ["another constructor", () => filled(new CountsPoints(500))],
    ["another species", () => filled(new OtherSpecies(1500))],
    ["a tag of its own", () => filled(new OwnTag(1500))],
    ["a subarray of its own", () => withOwn(plain(), "subarray", { value: () => null })],
    ["a length that is too long", () => withOwn(plain(), "length", { get: () => 4500 })],
    ["a negative length", () => withOwn(plain(), "length", { get: () => -3 })],
    ["a buffer of its own", () => withOwn(plain(), "buffer", { value: new ArrayBuffer(0) })],
  ];
  it.each(arrays)("are read by their real contents: %s", async (_, make) => {
    expect(hiddenPointRemoval(make(), farAway)).toEqual(expected);
    expect(hiddenPointRemoval(make(), farAway, { stride: 6 }).mask()).toHaveLength(250);
    for (const transfer of [false, true]) {
      const cloud = await WorkerPointCloud.create(make(), { transfer });
      expect(await cloud.visibleFrom(farAway)).toEqual(expected);
      await cloud.dispose();
    }
  });
});

describe("typed arrays of numbers", () => {
  const grid = Array.from({ length: 300 }, (_, i) => (i * i) % 101);
  const whole = new PointCloud(grid).visibleFrom([200, 50, 50]);
  it.each([Int8Array, Uint8Array, Uint8ClampedArray, Int16Array, Uint16Array, Int32Array, Uint32Array])(
    "of any kind are read, in double precision: %o",
    async (Type) => {
      expect(new PointCloud(Type.from(grid)).visibleFrom([200, 50, 50])).toEqual(whole);
      const strided = new PointCloud(Type.from(grid), { dimension: 2, stride: 3 });
      expect(strided.visibleFrom([200, 50])).toEqual(
        new PointCloud(grid, { dimension: 2, stride: 3 }).visibleFrom([200, 50]),
      );
      strided.append(Type.of(1, 2, 3));
      expect(strided).toHaveLength(101);
      const positions = Type.from(grid);
      const creating = WorkerPointCloud.create(positions);
      positions.fill(0);
      const remote = await creating;
      expect(await remote.visibleFrom([200, 50, 50])).toEqual(whole);
      await remote.dispose();
      await expectRefusal("option", /transfer/, () => WorkerPointCloud.create(positions, { transfer: true }));
      await expectRefusal("positions-type", /gone/, () => new PointCloud(transferredAway(positions)));
    },
  );

  it("stay apart if they are too large for single precision", () => {
    // A Float32Array rounds 2²⁴ + 1 to 2²⁴.
    const near = Int32Array.of(0, 0, 2 ** 24 + 1, 0, 0, 2 ** 24);
    expect([...new PointCloud(near).visibleFrom([0, 0, 2 ** 25]).indices]).toEqual([0]);
  });

  it("are refused if they hold 16-bit floats", async () => {
    // The tag of these arrays on platforms that have them.
    const halves = withOwn(new DataView(new ArrayBuffer(6)), Symbol.toStringTag, { value: "Float16Array" });
    await expectRefusal("positions-type", /Float16Array/, () => new PointCloud(loose(halves)));
  });
});

describe("sizes beyond every limit", () => {
  it("are refused before anything is copied", async () => {
    const tooMany = { length: 3 * (2 ** 28 + 1) };
    const names = /268435457 points.*268435456/;
    await expectRefusal("too-large", names, () => new PointCloud(tooMany));
    await expectRefusal("too-large", names, () => WorkerPointCloud.create(tooMany));
    await expectRefusal(
      "too-large",
      /2\d{9} coordinates|limit/,
      () => new PointCloud({ length: 2 ** 32 }, { stride: 64 }),
    );
  });

  it.each([2 ** 32, 2 ** 53 - 1])("are refused as a stride, too: %d", async (stride) => {
    for (const nothing of [[], new Float32Array(0)]) {
      await expectRefusal("option", /stride/, () => new PointCloud(nothing, { stride }));
    }
    expect(new PointCloud([], { stride: 2 ** 32 - 1 })).toHaveLength(0);
  });
});

describe("arguments that act while they are read", () => {
  const reading: [name: string, ask: (cloud: InstanceType<typeof PointCloud>, act: () => unknown) => unknown][] = [
    [
      "a viewpoint",
      (cloud, act) =>
        cloud.visibleFrom({
          length: 3,
          get 0() {
            act();
            return 0;
          },
          1: 0,
          2: 5,
        }),
    ],
    [
      "options",
      (cloud, act) =>
        cloud.visibleFrom(farAway, {
          get exponent() {
            act();
            return 1;
          },
        }),
    ],
    [
      "the viewpoint of autoRadius",
      (cloud, act) =>
        cloud.autoRadius({
          length: 3,
          0: 0,
          1: 0,
          get 2() {
            act();
            return 5;
          },
        }),
    ],
  ];
  it.each(reading)("cannot make a disposed cloud answer: %s", async (_, ask) => {
    const cloud = new PointCloud(sphere);
    await expectRefusal("disposed", /disposed/, () =>
      ask(cloud, () => {
        cloud.dispose();
      }),
    );

    // If another cloud takes its place, that cloud does not answer instead.
    const other = new PointCloud(sphere);
    const replace = () => {
      other.dispose();
      new PointCloud([7, 7, 7]);
    };
    await expectRefusal("disposed", /disposed/, () => ask(other, replace));
  });

  it.each([
    [
      "positions",
      (thrown: Error) =>
        new PointCloud({
          length: 3,
          get 0(): number {
            throw thrown;
          },
          1: 0,
          2: 0,
        }),
    ],
    [
      "a viewpoint",
      (thrown: Error) =>
        witness.visibleFrom({
          get length(): number {
            throw thrown;
          },
        }),
    ],
    [
      "options",
      (thrown: Error) =>
        witness.visibleFrom(farAway, {
          get radius(): number {
            throw thrown;
          },
        }),
    ],
  ])("have their errors passed on: %s", async (_, call) => {
    const thrown = new RangeError("mine");
    expect(await problemOf(() => call(thrown))).toBe(thrown);
  });

  it("are asked for their length once", () => {
    let length = 0;
    expect(
      new PointCloud({
        get length() {
          return (length += 3);
        },
        0: 1,
        1: 1,
        2: 1,
      }),
    ).toHaveLength(1);
  });

  it("may be revoked, or refuse to say what they are", async () => {
    const { proxy, revoke } = Proxy.revocable([], {});
    revoke();
    const secretive = {
      get [Symbol.toStringTag](): string {
        throw new Error("no");
      },
    };
    await expectRefusal("option", /unknown/, () => new PointCloud(sphere, loose(proxy)));
    await expectRefusal("positions-type", /unknown/, () => new PointCloud(loose(secretive)));
    await expectRefusal("positions-type", /positions\[0\]/, () => new PointCloud(loose([proxy, 1, 1])));
    await expectRefusal("viewpoint", /unknown/, () => witness.visibleFrom(loose(secretive)));
    // This error comes from the JavaScript engine itself.
    expect(await problemOf(() => new PointCloud(loose(proxy)))).toBeInstanceOf(TypeError);
  });
});

describe("options", () => {
  const polluted: object = Object.prototype;

  it.each([
    ["radius", 1],
    ["exponent", 3],
    ["stride", 9],
    ["nonFinite", "skip"],
    ["latest", 7],
    ["foo", 7],
  ])("are not read from Object.prototype: %s", async (name, value) => {
    withOwn(polluted, name, { value, enumerable: true, writable: true });
    try {
      expect(new PointCloud(sphere).visibleFrom(farAway)).toEqual(expected);
      expect(new PointCloud(sphere, {}).visibleFrom(farAway, {})).toEqual(expected);
      expect(hiddenPointRemoval(sphere, farAway, { dimension: 3 })).toEqual(expected);
      const cloud = await WorkerPointCloud.create(sphere);
      expect(await cloud.visibleFrom(farAway, {})).toEqual(expected);
      await cloud.dispose();
    } finally {
      Reflect.deleteProperty(polluted, name);
    }
  });

  class Settings {
    get exponent() {
      return 2;
    }
    describe() {
      return "anything";
    }
  }
  it.each<[string, object]>([
    ["inherited", Object.create({ exponent: 2 }) as object],
    ["of an object without a prototype", Object.assign(Object.create(null) as object, { exponent: 2 })],
    ["getters of a class", new Settings()],
    ["of another context", runInNewContext("({ exponent: 2 })") as object],
    ["behind a proxy", new Proxy({ exponent: 2 }, {})],
    ["hidden from enumeration", withOwn({}, "exponent", { value: 2 })],
  ])("count, wherever they are defined: %s", (_, options) => {
    expect(witness.visibleFrom(farAway, options).exponent).toBe(2);
    expect(hiddenPointRemoval(sphere, farAway, options).exponent).toBe(2);
  });

  it.each<[string, RegExp, unknown]>([
    ["a Map", /Map/, new Map([["exponent", 2]])],
    ["an array", /Array/, []],
    ["a promise", /Promise/, Promise.resolve({ exponent: 2 })],
    ["a symbol as a name", /Symbol\(exponent\)/, { [Symbol("exponent")]: 2 }],
    ["an unknown name that is inherited", /"foo"/, Object.create({ foo: 1 })],
    ["a prototype by name", /"__proto__"/, JSON.parse('{"__proto__":{"exponent":2}}')],
  ])("are refused if they would be ignored: %s", async (_, names, options) => {
    await expectRefusal("option", names, () => witness.visibleFrom(farAway, loose(options)));
    await expectRefusal("option", names, () => new PointCloud(sphere, loose(options)));
  });
});

describe("an answer", () => {
  it("says so when its indices were transferred away", async () => {
    const answer = witness.visibleFrom(farAway);
    transferredAway(answer.indices);
    const target = new Uint8Array(500).fill(9);
    await expectRefusal("disposed", /transferred/, () => answer.mask());
    await expectRefusal("disposed", /transferred/, () => {
      answer.maskInto(target);
    });
    await expectRefusal("disposed", /transferred/, () => answer.indicesInto(new Uint32Array(500)));
    expect(target.every((byte) => byte === 9)).toBe(true);
    expect(answer.count).toBe(expected.count);
  });

  it("is written into arrays of any context, and only into arrays", async () => {
    const mask = runInNewContext("new Uint8Array(500)") as Uint8Array;
    expected.maskInto(mask);
    expect([...mask]).toEqual([...expected.mask()]);
    const indices = runInNewContext("new Uint32Array(500)") as Uint32Array;
    expect(expected.indicesInto(indices)).toBe(expected.count);
    expect([...indices.subarray(0, expected.count)]).toEqual([...expected.indices]);

    await expectRefusal("option", /DataView$/, () => {
      expected.maskInto(loose(new DataView(new ArrayBuffer(500))));
    });
    await expectRefusal("option", /length 0/, () => {
      expected.maskInto(transferredAway(new Uint8Array(500)));
    });
    const pretender = { __proto__: Uint8Array.prototype, length: 500 };
    await expectRefusal("option", /maskInto/, () => {
      expected.maskInto(loose(pretender));
    });
    const none = new PointCloud([]).visibleFrom(farAway);
    await expectRefusal("option", /maskInto/, () => {
      none.maskInto(transferredAway(new Uint8Array(1)));
    });
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
    expect(await problemOf(() => remote.visibleFrom([0, 0, NaN], { signal: loose(raising) }))).toBeInstanceOf(
      RangeError,
    );
    expect((await remote.visibleFrom(farAway)).count).toBe(expected.count);
    await remote.dispose();
    await later();
    process.off("unhandledRejection", note);
    expect(unhandled).toEqual([]);
  });

  it("leave a waiting request alone if they aborted before", async () => {
    const remote = await WorkerPointCloud.create(sphere);
    const running = remote.visibleFrom([0, 0, 4]);
    const live = remote.visibleFrom(farAway, { latest: true });
    const dead = problemOf(() => remote.visibleFrom([0, 0, 6], { latest: true, signal: AbortSignal.abort() }));
    expect((await dead).name).toBe("AbortError");
    expect(await live).toEqual(expected);
    await running;
    await remote.dispose();
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
    [/got infinity$/, () => witness.visibleFrom(farAway, { radius: Infinity })],
    [/got 0$/, () => witness.visibleFrom(farAway, { radius: 0 })],
    [/got 0, -infinity, 5$/, () => witness.visibleFrom([0, -Infinity, 5])],
    [/radius 5 is/, () => witness.visibleFrom(farAway, { radius: 5 })],
    [/radius 1e308 /, () => witness.visibleFrom(farAway, { radius: 1e308 })],
  ])("write numbers plainly: %s", async (names, call) => {
    expect((await problemOf(call)).message).toMatch(names);
  });

  it.each<[RegExp, () => unknown]>([
    [/from the given Response:/, () => new Response(new Uint8Array(3))],
    [/from an empty address:/, () => ""],
  ])("name the file that was to be loaded: %s", async (names, input) => {
    const fresh = await freshPackage();
    expect((await problemOf(() => fresh.init(input() as never))).message).toMatch(names);
  });
});
