import { describe, expect, it } from "vitest";

import { expectRefusal, problemOf, readyPackage } from "./support";

const { mergeVisible, HprError } = await readyPackage();

const farAway = [0, 0, 5];
const loose = (value: unknown) => value as never;

describe("parts that were seen with one radius", () => {
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
    ["option", /radius.*"opposite"/, [part], { radius: "opposite" }],
    ["option", /"exponent"/, [part], { exponent: 2 }],
    ["option", /"exponent"/, [part], { radius: 100, exponent: 2 }],
    ["option", /"looks"/, [part], { radius: 100, looks: 3 }],
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
    ["option", /parts\[0\]: ids.*undefined/, [{ positions: [0, 0, 1] }], radius],
    ["option", /parts\[1\]: ids.*Array/, [part, { positions: [0, 0, 1], ids: [1] }], radius],
    ["option", /parts\[0\]: ids.*Int32Array/, [{ positions: [0, 0, 1], ids: new Int32Array(1) }], radius],
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

  it.each(refusals)("%s, naming %s: case %#", (code, names, parts, options, viewpoint = farAway) =>
    expectRefusal(code, names, () => mergeVisible(loose(parts), loose(viewpoint), loose(options))),
  );

  it.each<["positions" | "ids", string, RegExp]>([
    ["positions", "positions-type", /^parts\[0\]: the memory of the positions is gone/],
    ["ids", "option", /^parts\[0\]: ids has been transferred away/],
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
      await expectRefusal(code, message, () => mergeVisible([first, second], farAway, radius));
    }
  });

  it("with the refusal of the part itself as the cause", async () => {
    const problem = await problemOf(() => mergeVisible([{ positions: [0, 0, 1, 2], ids }], farAway, radius));
    expect(problem.cause).toBeInstanceOf(HprError);
    expect(problem.message).toBe(`parts[0]: ${(problem.cause as Error).message}`);
  });
});
