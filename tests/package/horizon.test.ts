import { describe, expect, it } from "vitest";

import { bumpySphere, readyPackage } from "./support";

const { Horizon, HprError } = await readyPackage();

const sphere = bumpySphere(1, 6000);
const viewpoint = [0, 0, 5];
const options = { radius: 500 };
/** The code of the error that `call` throws. */
function codeOf(call: () => unknown): string {
  try {
    call();
  } catch (error) {
    return error instanceof HprError ? error.code : String(error);
  }
  return "nothing was thrown";
}
const loose = (value: unknown) => value as never;

describe("a horizon", () => {
  it("refuses bad input with a code, and stays as it was", () => {
    const horizon = new Horizon(viewpoint, options);
    horizon.add(sphere);
    const before = horizon.visible();
    expect(codeOf(() => horizon.add([0, 0, NaN]))).toBe("non-finite");
    expect(codeOf(() => horizon.add([0, 0]))).toBe("positions-length");
    expect(codeOf(() => horizon.screen(loose("points")))).toBe("positions-type");
    expect(codeOf(() => horizon.add([0, 0, 1e6]))).toBe("radius");
    expect(codeOf(() => horizon.screen([0, 0, 1e6]))).toBe("radius");
    expect(codeOf(() => horizon.hidesBox([0, 0, 0], [1, 1, -1]))).toBe("option");
    expect(codeOf(() => horizon.hidesBox(loose([0, 0]), [1, 1, 1]))).toBe("option");
    expect(horizon.visible()).toEqual(before);
    expect(codeOf(() => new Horizon([0, NaN, 0], options))).toBe("viewpoint");
    expect(codeOf(() => new Horizon(viewpoint, {}))).toBe("option");
    expect(codeOf(() => new Horizon(viewpoint, { inversion: loose({ exponential: "auto" }) }))).toBe("option");
    expect(codeOf(() => new Horizon(viewpoint, { radius: -1 }))).toBe("radius");
    horizon.dispose();
    horizon.dispose();
    expect(codeOf(() => horizon.add(sphere))).toBe("disposed");
    expect(codeOf(() => horizon.hidesBox([0, 0, 0], [1, 1, 1]))).toBe("disposed");
  });
});
