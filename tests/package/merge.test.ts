import { describe, expect, it } from "vitest";

import { bumpySphere, bunny, freshPackage, pointsAt, problemOf, randomNumbers, readyPackage } from "./support";

const { mergeVisible, PointCloud, HprError } = await readyPackage();

type Part = Parameters<typeof mergeVisible>[0][number];

const sphere = bumpySphere(1, 3000);
const farAway = [0, 0, 5];
const loose = (value: unknown) => value as never;

/** Divides a cloud at random and keeps the visible points of each part. */
function visibleParts(points: Float32Array, count: number, viewpoint: number[], radius: number): Part[] {
  const random = randomNumbers(count);
  const ids = Array.from({ length: count }, (): number[] => []);
  for (let i = 0; i < points.length / 3; i++) ids[Math.floor(random() * count)]!.push(i);
  return ids.map((own, number) => {
    const xyz = own.flatMap((i) => [...points.subarray(3 * i, 3 * i + 3)]);
    const { indices } = new PointCloud(xyz).visibleFrom(viewpoint, { radius });
    const positions = [...indices].flatMap((k) => xyz.slice(3 * k, 3 * k + 3));
    const forms = [positions, Float32Array.from(positions), Float64Array.from(positions)];
    return { positions: forms[number % 3]!, ids: indices.map((k) => own[k]!) };
  });
}

describe("parts that were seen with one radius", () => {
  it.each([
    ["a bumpy sphere", sphere, farAway],
    ["a bumpy sphere, from inside", sphere, [0.1, 0.2, -0.3]],
    ["the bunny", bunny(), [0, 5, 20]],
    ["the bunny, from inside", bunny(), [-1.5, 5, 0]],
  ])("merge to the answer of the whole: %s", (_, points, viewpoint) => {
    const { indices, radius } = new PointCloud(points).visibleFrom(viewpoint);
    for (const count of [1, 2, 5, 40]) {
      const parts = visibleParts(points, count, viewpoint, radius);
      expect(mergeVisible(parts, viewpoint, { radius })).toEqual(indices);
    }
    const everything = { positions: points, ids: Uint32Array.from({ length: points.length / 3 }, (_, i) => i) };
    expect(mergeVisible([everything], viewpoint, { radius, inversion: "spherical" })).toEqual(indices);
  });

  it.each<[string, object]>([
    ["a power", { inversion: { power: 3 } }],
    ["a power of a given unit", { radius: 50, inversion: { power: 1.2 } }],
    ["an exponential", { inversion: { exponential: 0.004 } }],
    ["an exponential of its own scale", { inversion: { exponential: "auto" } }],
  ])("merge with the inversion of the answer: %s", (_, options) => {
    const whole = new PointCloud(sphere).visibleFrom(farAway, options);
    const together =
      whole.radius > 0 ? { radius: whole.radius, inversion: whole.inversion } : { inversion: whole.inversion };
    const parts = [0, 1500].map((first) => {
      const own = sphere.subarray(3 * first, 3 * first + 4500);
      const { indices } = new PointCloud(own).visibleFrom(farAway, together);
      return { positions: pointsAt(own, [...indices]), ids: indices.map((i) => first + i) };
    });
    expect(mergeVisible(parts, farAway, together)).toEqual(whole.indices);
  });

  it("are read in double precision if one of them is double, in any order", () => {
    // In single precision 1 + 2⁻⁴⁰ is 1, and both points would be visible.
    const single = { positions: Float32Array.of(0, 0, 1, 5, 5, 5), ids: Uint32Array.of(1, 3) };
    const double = { positions: Float64Array.of(0, 0, 1 + 2 ** -40), ids: Uint32Array.of(2) };
    expect(mergeVisible([single, double], farAway, { radius: 100 })).toEqual(Uint32Array.of(2, 3));
    expect(mergeVisible([double, single], farAway, { radius: 100 })).toEqual(Uint32Array.of(2, 3));
    const whole = { positions: Int16Array.of(0, 0, 1, 5, 5, 5), ids: Uint32Array.of(1, 3) };
    expect(mergeVisible([whole, double], farAway, { radius: 100 })).toEqual(Uint32Array.of(2, 3));
  });
});

describe("refusals", () => {
  const ids = Uint32Array.of(7);
  const part = { positions: [0, 0, 1], ids };
  const radius = { radius: 100 };
  const refusals: [code: string, names: RegExp, parts: unknown, options: unknown, viewpoint?: unknown][] = [
    ["option", /radius.*undefined/, [part], {}],
    ["option", /radius.*undefined/, [part], undefined],
    ["option", /radius.*"auto"/, [part], { radius: "auto" }],
    ["option", /radius.*"search"/, [part], { radius: "search" }],
    ["option", /"exponent"/, [part], { exponent: 2 }],
    ["option", /"exponent"/, [part], { radius: 100, exponent: 2 }],
    ["option", /"denoise"/, [part], { radius: 100, denoise: 8 }],
    ["option", /radius.*undefined/, [part], { inversion: { power: 2 } }],
    ["option", /inversion power.*17/, [part], { radius: 100, inversion: { power: 17 } }],
    ["option", /inversion exponential.*"auto"/, [part], { inversion: { exponential: "auto" } }],
    ["option", /radius.*inversion exponential/, [part], { radius: 100, inversion: { exponential: 1 } }],
    ["option", /radius.*"auto"/, [part], { radius: "auto", inversion: { exponential: 1 } }],
    ["option", /inversion.*"cubic"/, [part], { radius: 100, inversion: "cubic" }],
    ["option", /parts.*undefined/, undefined, radius],
    ["option", /parts.*Object/, part, radius],
    ["option", /parts\[1\].*null/, [part, null], radius],
    ["option", /parts\[0\].*undefined/, new Array(1), radius],
    ["option", /parts\[0\]\.ids.*undefined/, [{ positions: [0, 0, 1] }], radius],
    ["option", /parts\[1\]\.ids.*Array/, [part, { positions: [0, 0, 1], ids: [1] }], radius],
    ["option", /parts\[0\]\.ids.*Int32Array/, [{ positions: [0, 0, 1], ids: new Int32Array(1) }], radius],
    ["positions-type", /parts\[1\].*undefined/, [part, { ids }], radius],
    ["positions-type", /parts\[0\].*positions\[1\].*"0"/, [{ positions: [0, "0", 1], ids }], radius],
    ["positions-length", /parts\[0\].*got 4\b/, [{ positions: [0, 0, 1, 2], ids }], radius],
    ["positions-length", /parts\[1\].*1 ids.*got 6\b/, [part, { positions: new Float32Array(6), ids }], radius],
    ["non-finite", /\b1 point.*index 1\b/, [part, { positions: [0, NaN, 1], ids }], radius],
    ["viewpoint", /2 of them/, [part], radius, [0, 0]],
    ["viewpoint", /NaN/, [part], radius, [0, 0, NaN]],
    ["radius", /\b3\.5\b.*farthest.*\b4\b/, [part], { radius: 3.5 }],
    ["radius", /NaN/, [], { radius: NaN }],
    ["radius", /\b0\b/, [part], { radius: 0 }],
  ];

  it.each(refusals)("%s, naming %s: case %#", async (code, names, parts, options, viewpoint = farAway) => {
    const problem = await problemOf(() => mergeVisible(loose(parts), loose(viewpoint), loose(options)));
    expect(problem).toBeInstanceOf(HprError);
    expect(problem.code).toBe(code);
    expect(problem.message).toMatch(names);
  });

  it.each<["positions" | "ids", string, RegExp]>([
    ["positions", "positions-type", /^parts\[0\]: the memory of the positions is gone/],
    ["ids", "option", /^parts\[0\]\.ids has been transferred away/],
  ])("refuses %s if the getter of a later part takes their memory away: %s", async (what, code, message) => {
    for (const Type of [Float32Array, Float64Array]) {
      const first = { positions: Type.of(0, 0, 1), ids: Uint32Array.of(1) };
      const second = {
        get positions() {
          const { buffer } = first[what];
          structuredClone(buffer, { transfer: [buffer] });
          return [0, 1, 0];
        },
        ids,
      };
      const problem = await problemOf(() => mergeVisible([first, second], farAway, radius));
      expect(problem).toBeInstanceOf(HprError);
      expect(problem.code).toBe(code);
      expect(problem.message).toMatch(message);
    }
  });

  it("with the refusal of the part itself as the cause", async () => {
    const problem = await problemOf(() => mergeVisible([{ positions: [0, 0, 1, 2], ids }], farAway, radius));
    expect(problem.cause).toBeInstanceOf(HprError);
    expect(problem.message).toBe(`parts[0]: ${(problem.cause as Error).message}`);
  });

  it("not-initialised, before init() has resolved", async () => {
    const fresh = await freshPackage();
    expect((await problemOf(() => fresh.mergeVisible([part], farAway, radius))).code).toBe("not-initialised");
  });
});
