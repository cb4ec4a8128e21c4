import { describe, expect, it } from "vitest";

import { expectRefusal, freshPackage, problemOf, readyPackage } from "./support";

const { permissibleCurvature, radiusBound } = await readyPackage();
const loose = (value: unknown) => value as never;

describe("the paper's bounds", () => {
  const refusals: [names: RegExp, call: () => unknown][] = [
    [/\br\b.*\b0$/, () => permissibleCurvature(1, 0, 1)],
    [/\bR\b.*got 1$/, () => permissibleCurvature(1, 2, 1)],
    [/beta.*got 4/, () => permissibleCurvature(2, 1, 4)],
    [/beta.*NaN/, () => permissibleCurvature(2, 1, NaN)],
    [/beta.*undefined/, () => permissibleCurvature(2, 1, loose(undefined))],
    [/\bR\b.*"2"/, () => permissibleCurvature(loose("2"), 1, 1)],
    [/thickness.*-1/, () => radiusBound(-1, 1, 1)],
    [/distance.*Infinity|distance.*infinity/, () => radiusBound(1, Infinity, 1)],
    [/spacing.*null/, () => radiusBound(1, 1, loose(null))],
  ];
  it.each(refusals)("refuse with an option error that names %s", (names, call) => expectRefusal("option", names, call));
});

it("nothing answers before init() has resolved", async () => {
  const fresh = await freshPackage();
  const calls = [
    () => fresh.radiusBound(1, 1, 1),
    () => fresh.permissibleCurvature(1, 1, 1),
    () => fresh.ringOfViewpoints([0, 0, 5], [0, 0, 0]),
  ];
  for (const call of calls) expect((await problemOf(call)).code).toBe("not-initialised");
});
