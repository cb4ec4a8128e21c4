import { expect, it } from "vitest";

import { bumpySphere, expectRefusal, readyPackage } from "./support";

const { PointCloud } = await readyPackage();

const positions = bumpySphere(5, 6000);
const from = [0.3, 0.8, 2.5];

it("choices that make no sense are refused", async () => {
  const between = (...corners: unknown[][]) => ({ box: corners });
  const cloud = new PointCloud(positions);
  const bad: [unknown, RegExp][] = [
    [5, /within: the options must be a plain object/],
    [{ radius: 5 }, /within: unknown option "radius"/],
    [{ distance: "5" }, /distance must be a number/],
    [{ distance: -1 }, /within distance must be from 0 to infinity, got -1/],
    [{ distance: NaN }, /within distance/],
    [{ box: [[0, 0, 0]] }, /within box must be \[min, max\], each with 3 numbers/],
    [between([0, 0], [1, 1]), /within box/],
    [between([0, 0, "0"], [1, 1, 1]), /within box/],
    [between([0, 0, 0], [1, 1, NaN]), /within box/],
    [between([2, 0, 0], [1, 1, 1]), /no coordinate of min is above/],
    [{ mask: [1, 0] }, /within mask must be a Uint8Array/],
    [{ mask: new Uint8Array(3) }, /one element for each of 6000 indices, got 3/],
  ];
  for (const [within, message] of bad) {
    for (const ask of [
      () => cloud.visibleFrom(from, { within: within as object }),
      () => cloud.visibleFromAny([from], { within: within as object }),
    ]) {
      await expectRefusal("option", message, ask);
    }
  }
  expect(() => cloud.visibleFromDirection(from, { within: { distance: 3 } })).toThrow(
    /within distance cannot be combined with a direction/,
  );
  const four = new PointCloud(new Float64Array(16), { dimension: 4 });
  expect(() => four.visibleFrom([1, 2, 3, 4], { within: {} })).toThrow(/within needs a cloud of dimension 3, not 4/);
  four.dispose();
  cloud.dispose();
});
