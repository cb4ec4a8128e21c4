// Properties of functions that need no cloud, and of arrays that an answer writes into.
import fc from "fast-check";
import { permissibleCurvature, PointCloud, radiusBound, ringOfViewpoints } from "hidden-point-removal";
import { JUNK, transferredAway } from "./argument.js";
import { judge, outcomeOf, require } from "./outcome.js";
import { viewpoint } from "./points.js";

const loose = (value: unknown) => value as never;
const anyNumber = fc.oneof(
  fc.double(),
  fc.constantFrom(0, -0, 1, Math.PI / 2, NaN, Infinity, -Infinity, 5e-324, 1.7e308),
);
const anything = fc.oneof(
  { weight: 5, arbitrary: anyNumber },
  { weight: 1, arbitrary: fc.constantFrom(...JUNK).map(([, make]) => make()) },
);

/** A formula gives a number, or is refused with `option`. */
export const formulas = fc.asyncProperty(anything, anything, anything, async (a, b, c) => {
  for (const formula of [permissibleCurvature, radiusBound]) {
    const found = await outcomeOf(() => formula(loose(a), loose(b), loose(c)));
    const sure = [a, b, c].some((x) => typeof x !== "number" || !(x >= 0) || !Number.isFinite(x));
    judge(formula.name, { codes: ["option"], sure }, found);
    require("refused" in found || typeof found.answer === "number", `${formula.name} gave no number`);
  }
});

/** A ring has the requested number of viewpoints, at the requested distance from its middle. */
export const rings = fc.asyncProperty(
  viewpoint(3),
  viewpoint(3),
  anything,
  anything,
  async (from, to, count, fraction) => {
    const isCount = Number.isInteger(count) && (count as number) >= 1 && (count as number) <= 10_000;
    const isFraction = typeof fraction === "number" && fraction >= 0 && fraction < Infinity;
    const options = { count, fraction };
    const wrong = (count !== undefined && !isCount) || (fraction !== undefined && !isFraction);
    const found = await outcomeOf(() => ringOfViewpoints(loose(from.make()), loose(to.make()), loose(options)));
    // A ring with a radius of 1e308 overflows. So may a ring around a place that is very far away.
    const far = [from, to].some(({ codes }) => codes.includes("radius")) || (isFraction && fraction > 1e300);
    const codes = [...(from.sure || to.sure || far ? ["viewpoint"] : []), ...(wrong || far ? ["option"] : [])];
    judge(
      `ringOfViewpoints with ${String(count)}, ${String(fraction)}`,
      { codes, sure: from.sure || to.sure || wrong },
      found,
    );
    if ("answer" in found && !far) {
      const ring = found.answer as number[][];
      require(ring.length === (count ?? 4), `${ring.length} viewpoints`);
      const distance = (a: readonly number[], b: readonly number[]) => Math.hypot(...a.map((x, i) => x - b[i]!));
      const expected = ((fraction as number | undefined) ?? 0.05) * distance(from.meaning, to.meaning);
      const worst = Math.max(...ring.map((place) => Math.abs(distance(place, from.meaning) - expected)));
      require(worst <= 1e-9 * (1 + expected), `a viewpoint is ${worst} off`);
    }
  },
);

const cloud = () => new PointCloud([0, 0, 1, 0, 0, 2, 1, 0, 0, 0, 1, 0]);
/** The contents of an array. The array may have been transferred away. */
const contents = (array: ArrayLike<unknown>) => Array.from({ length: array.length }, (_, i) => array[i]).join();
const TARGETS = [Uint8Array, Uint8ClampedArray, Int32Array, Uint32Array, Float32Array, BigInt64Array];

/** An array with enough room and the right type is written to. Others are refused with `option`, and not written to. */
export const outputs = fc.asyncProperty(
  fc.constantFrom(...TARGETS),
  fc.nat({ max: 6 }),
  fc.boolean(),
  fc.constantFrom(...JUNK),
  async (Type, length, gone, [name, make]) => {
    const whole = cloud();
    const answer = whole.visibleFrom([0, 0, 9]);
    const target = gone ? transferredAway(new Type(length)) : new Type(length);
    const room = target.length;
    const masks = Type === Uint8Array && room >= 4;
    const lists = Type === Uint32Array && room >= answer.count;
    const rule = (accepted: boolean) => ({ codes: accepted ? [] : ["option"], sure: !accepted });
    const before = contents(target);
    const masked = await outcomeOf(() => {
      answer.maskInto(loose(target));
    });
    judge(`maskInto(${Type.name} of ${room})`, rule(masks), masked);
    const listed = await outcomeOf(() => answer.indicesInto(loose(target)));
    judge(`indicesInto(${Type.name} of ${room})`, rule(lists), listed);
    const after = contents(target);
    require(masks || lists || before === after, "a refused target was written to");
    require(!masks || after.startsWith([...answer.mask()].join()), "a mask was written wrongly");
    require(!lists || after.startsWith([...answer.indices].join()), "indices were written wrongly");
    for (const write of ["maskInto", "indicesInto"] as const) {
      judge(`${write}(${name})`, rule(false), await outcomeOf(() => answer[write](loose(make()))));
    }
    judge(
      `recycle(${name})`,
      rule(false),
      await outcomeOf(() => {
        whole.recycle(loose(make()));
      }),
    );
    whole.dispose();
  },
);
