import { OUTSIDE, partsOf, VISIBLE } from "../view/parts.ts";
import type { PictureAnswer, PictureQuestion } from "./protocol.ts";
import { receive } from "./receive.ts";
import { Projected, zBuffer } from "./zbuffer.ts";

receive((positions, { picture, splat, visible: ours }: PictureQuestion): Promise<PictureAnswer> => {
  const asked = performance.now();
  const projected = new Projected(positions, picture);
  const known = performance.now();
  // The choice of a width is not part of the measured time.
  const width = typeof splat === "number" ? splat : projected.splatFor(splat.spacing);
  const chosen = performance.now();
  const said = zBuffer(projected, width);
  const milliseconds = known - asked + (performance.now() - chosen);
  const count = (kind: number) => said.reduce((sum, one) => sum + (one === kind ? 1 : 0), 0);
  return Promise.resolve({
    parts: partsOf(said, ours),
    splat: width,
    inside: said.length - count(OUTSIDE),
    visible: count(VISIBLE),
    milliseconds,
  });
});
