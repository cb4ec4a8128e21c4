// The entry with the operator alone: the same bits as the main entry, and refusals of everything else.
import * as full from "hidden-point-removal";
import * as lite from "hidden-point-removal/lite";
import { beforeAll, describe, expect, it, vi } from "vitest";

import { bumpySphere, liteBytes, problemOf, randomNumbers } from "./support";
import { trappingWasm } from "./trapping-wasm";

beforeAll(async () => {
  await Promise.all([full.init(), lite.init()]);
});

const farAway = [0, 0, 5];
const sphere = bumpySphere(1, 500);

/** A cloud of points in a box, on a grid, or on a sphere, for some numbers twice, in either precision. */
function cloudOf(random: () => number, dimension: number, count: number): Float32Array | Float64Array {
  const shape = Math.floor(3 * random());
  const place = () => {
    const numbers = Array.from({ length: dimension }, () => 2 * random() - 1);
    if (shape === 0) return numbers;
    if (shape === 1) return numbers.map((x) => Math.round(4 * x) / 4);
    return numbers.map((x) => x / Math.hypot(...numbers));
  };
  const numbers = Array.from({ length: count }, place).flat();
  return random() < 0.5 ? Float32Array.from(numbers) : Float64Array.from(numbers);
}

function optionsOf(random: () => number): lite.VisibilityOptions {
  const choices: (() => lite.VisibilityOptions)[] = [
    () => ({}),
    () => ({ radius: "auto" }),
    () => ({ radius: 10 + 100 * random() }),
    () => ({ exponent: 4 * random() }),
    () => ({ inversion: { power: 1.01 + 5 * random() } }),
    () => ({ inversion: { power: 1.5 }, radius: 20 }),
    () => ({ inversion: { exponential: "auto" } }),
    () => ({ inversion: { exponential: random() } }),
  ];
  return choices[Math.floor(choices.length * random())]!();
}

/** The whole answer, comparable to the bit. */
const told = ({ indices, radius, exponent, evaluations, inversion, exact }: lite.Visibility | full.Visibility) => ({
  ...{ indices: [...indices], radius, exponent, evaluations, inversion, exact },
});

describe.each([2, 3] as const)("in %i dimensions, random clouds", (dimension) => {
  it("have the answers of the main entry, before and after changes", () => {
    const random = randomNumbers(dimension);
    const place = () => Array.from({ length: dimension }, () => 3 * random() - 1.5);
    let seen = 0;
    for (let round = 0; round < 60; round++) {
      // Some have enough points for a map of depths and for their noise.
      const count = round % 15 === 0 ? 5000 : Math.floor(200 * random());
      const positions = cloudOf(random, dimension, count);
      const clouds = [full, lite].map(({ PointCloud }) => new PointCloud(positions, { dimension })) as [
        full.PointCloud,
        lite.PointCloud,
      ];
      const compare = () => {
        for (let question = 0; question < 3; question++) {
          const [viewpoint, options] = [place(), optionsOf(random)];
          const [expected, answer] = clouds.map((cloud) => cloud.visibleFrom(viewpoint, options as object));
          expect(told(answer!)).toEqual(told(expected!));
          expect(answer!.mask()).toEqual(expected!.mask());
          expect(clouds[1].autoRadius(viewpoint)).toEqual(clouds[0].autoRadius(viewpoint));
          seen += answer!.count;
        }
        expect([clouds[1].length, clouds[1].skipped]).toEqual([clouds[0].length, clouds[0].skipped]);
      };
      compare();
      const more = cloudOf(random, dimension, Math.floor(100 * random()));
      const gone = Array.from(positions.keys()).filter((i) => i < count && random() < 0.3);
      for (const cloud of clouds) cloud.append(more);
      compare();
      for (const cloud of clouds) cloud.remove(gone);
      compare();
      for (const cloud of clouds) cloud.dispose();
    }
    expect(seen).toBeGreaterThan(1000);
  });
});

it("skips what is not finite, and reads strides, as the main entry", () => {
  const positions = [0, 0, 1, 9, NaN, 0, 0, 9, 0, 0, 2, 9];
  const options = { stride: 4, nonFinite: "skip" } as const;
  const [expected, answer] = [full, lite].map((entry) => entry.hiddenPointRemoval(positions, farAway, options));
  expect(told(answer!)).toEqual(told(expected!));
  expect([...answer!.indices]).toEqual([2]);
});

type AnyOptions = Record<string, unknown>;

it.each<AnyOptions>([
  { looks: 3 },
  { looks: 3, scores: true },
  { thickness: 1 },
  { within: { distance: 3 } },
  { radius: "opposite" },
  { radius: 10, exponent: 2 },
  { radius: 10, inversion: { exponential: 1 } },
  { exponent: 2, inversion: { power: 2 } },
  { exponent: 2, inversion: { exponential: "auto" } },
  { inversion: { looks: [1, 2] } },
  { inversion: { power: 1 } },
  { inversion: { exponential: -1 } },
  { exponent: -1 },
  { unknown: 1 },
])("%j is refused with the code option", async (options) => {
  const cloud = new lite.PointCloud(sphere);
  for (const call of [
    () => cloud.visibleFrom(farAway, options),
    () => lite.hiddenPointRemoval(sphere, farAway, options),
  ]) {
    expect((await problemOf(call)).code).toBe("option");
  }
  // A refusal changes nothing.
  expect(told(cloud.visibleFrom(farAway))).toEqual(told(full.hiddenPointRemoval(sphere, farAway)));
});

it("refuses other dimensions and other rules with the code option, and names them", async () => {
  const { PointCloud } = lite;
  const dimension = (number: number) => problemOf(() => new PointCloud([1, 2, 3, 4], { dimension: number as 3 }));
  for (const number of [1, 4, 64, 2.5]) expect(await dimension(number)).toMatchObject({ code: "option" });
  expect((await dimension(4)).message).toBe("dimension must be an integer from 2 to 3, got 4");
  const cloud = new PointCloud(sphere);
  for (const rule of ["opposite", 3, null]) {
    const refused = await problemOf(() => cloud.autoRadius(farAway, rule as "auto"));
    expect(refused).toMatchObject({ code: "option" });
    expect(refused).toBeInstanceOf(lite.HprError);
  }
});

it("refuses bad input with the codes of the main entry", async () => {
  const bad: [call: (entry: typeof full | typeof lite) => unknown, code: string][] = [
    [({ PointCloud }) => new PointCloud([1, 2]), "positions-length"],
    [({ PointCloud }) => new PointCloud("1, 2, 3" as never), "positions-type"],
    [({ PointCloud }) => new PointCloud([1, 2, NaN]), "non-finite"],
    [({ hiddenPointRemoval }) => hiddenPointRemoval(sphere, [0, 0]), "viewpoint"],
    [({ hiddenPointRemoval }) => hiddenPointRemoval(sphere, [0, 0, Infinity]), "viewpoint"],
    [({ hiddenPointRemoval }) => hiddenPointRemoval(sphere, farAway, { radius: 1 }), "radius"],
    [
      ({ PointCloud }) => {
        new PointCloud(sphere).remove([500]);
      },
      "option",
    ],
    [
      ({ PointCloud }) => {
        const cloud = new PointCloud(sphere);
        cloud.dispose();
        cloud.dispose();
        cloud.append(sphere);
      },
      "disposed",
    ],
  ];
  for (const [call, code] of bad) {
    const [expected, problem] = [await problemOf(() => call(full)), await problemOf(() => call(lite))];
    expect(problem).toMatchObject({ name: "HprError", code, message: expected.message });
    expect(expected.code).toBe(code);
  }
});

describe("on a fresh page", () => {
  async function fresh() {
    vi.resetModules();
    return { ...(await import("hidden-point-removal/lite")), full: await import("hidden-point-removal") };
  }

  it("starts a wasm of its own: neither entry starts or stops the other", async () => {
    const page = await fresh();
    expect((await problemOf(() => new page.PointCloud(sphere))).code).toBe("not-initialised");
    await page.init();
    const cloud = new page.PointCloud(sphere);
    expect((await problemOf(() => new page.full.PointCloud(sphere))).code).toBe("not-initialised");
    await page.full.init(trappingWasm("visibleFrom"));
    expect((await problemOf(() => page.full.hiddenPointRemoval(sphere, farAway))).code).toBe("internal");
    expect(cloud.visibleFrom(farAway).count).toBeGreaterThan(10);
  });

  it("initSync takes the bytes or the module", async () => {
    for (const input of [liteBytes(), new WebAssembly.Module(liteBytes())]) {
      const page = await fresh();
      page.initSync(input);
      expect(page.hiddenPointRemoval(sphere, farAway).count).toBeGreaterThan(10);
    }
  });

  it("says in `load` how to serve this entry's file", async () => {
    const page = await fresh();
    const problem = await problemOf(() => page.init("/nowhere/hpr.wasm"));
    expect(problem.code).toBe("load");
    expect(problem.message).toContain("hidden-point-removal/lite/hpr.wasm");
    await page.init();
  });
});
