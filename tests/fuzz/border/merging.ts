// Properties of mergeVisible: parts of every form, good and bad, and getters that take memory away.
import fc from "fast-check";
import { mergeVisible, PointCloud } from "hidden-point-removal";
import { type Argument, bad, good, JUNK, named, transferredAway } from "./argument.js";
import { agree, judge, outcomeOf } from "./outcome.js";
import { positions, viewpoint } from "./points.js";

type Part = Argument<readonly number[]>;
const loose = (value: unknown) => value as never;

const badIds: Argument<undefined>[] = [
  ...JUNK.map(([name, make]) => bad("option", name, make, undefined)),
  bad("option", "an array", () => [1], undefined),
  bad("option", "signed", () => new Int32Array(1), undefined),
  bad("option", "transferred away", () => transferredAway(new Uint32Array(3)), undefined),
];

/** A part whose ids count up from `first`. A `short` part has one id too few. */
const part = fc
  .tuple(
    positions(3, 3, false, 10),
    fc.oneof(
      { weight: 12, arbitrary: fc.constant<"fit">("fit") },
      { weight: 1, arbitrary: fc.constant<"short">("short") },
      { weight: 2, arbitrary: fc.constantFrom(...badIds) },
    ),
  )
  .map(([points, ids]) => ({ points, ids }));

function asArgument(
  { points, ids }: { points: Part; ids: "fit" | "short" | Argument<undefined> },
  first: number,
): Part {
  if (typeof ids === "object") {
    return {
      ...points,
      name: `${points.name} with ids ${ids.name}`,
      make: () => ({ positions: points.make(), ids: ids.make() }),
      codes: [...points.codes, ...ids.codes],
      sure: true,
    };
  }
  const count = points.meaning.length / 3;
  const more = ids === "short" ? 1 : 0;
  const own = () => Uint32Array.from({ length: count + more }, (_, i) => first + i);
  return {
    ...points,
    name: `${points.name} with ids from ${first}${more ? ", one too many" : ""}`,
    make: () => ({ positions: points.make(), ids: own() }),
    codes: more ? [...points.codes, "positions-length"] : points.codes,
    sure: points.sure || more > 0,
  };
}

type Parts = Argument<readonly number[]>;

const partList: fc.Arbitrary<Parts> = named(
  fc.oneof(
    {
      weight: 12,
      arbitrary: fc.array(part, { maxLength: 4 }).map((list): Parts => {
        const own: Part[] = [];
        let first = 0;
        for (const one of list) {
          own.push(asArgument(one, first));
          first += one.points.meaning.length / 3;
        }
        return {
          name: own.map(({ name }) => name).join("; "),
          make: () => own.map(({ make }) => make()),
          codes: own.flatMap(({ codes }) => codes),
          sure: own.some(({ sure }) => sure),
          meaning: own.flatMap(({ meaning }) => [...meaning]),
        };
      }),
    },
    { weight: 1, arbitrary: fc.constantFrom(...JUNK.map(([name, make]): Parts => bad("option", name, make, []))) },
  ),
);

const options = named(
  fc.constantFrom(
    ...[
      { radius: 1e3 },
      { radius: 1e6, inversion: "spherical" as const },
      { radius: 60, inversion: { power: 3 } },
      { inversion: { exponential: 0.3 } },
    ].map((it) => good(JSON.stringify(it), it)),
    ...[
      {},
      { radius: "auto" },
      { exponent: 3 },
      { radius: 1e3, denoise: 2 },
      { radius: 1e3, inversion: { power: 17 } },
      { radius: 1e3, inversion: { exponential: 1 } },
      { inversion: { exponential: "auto" } },
    ].map((it) => bad("option", JSON.stringify(it), () => it, {})),
    ...[0, -1, NaN, Infinity].map((radius) => bad("radius", `radius ${radius}`, () => ({ radius }), {})),
    ...JUNK.map(([name, make]) => bad("option", name, make, {})),
  ),
);

/** Merged parts equal the answer of one cloud of all points, in double precision. */
export const merges = fc.asyncProperty(partList, viewpoint(3), options, async (parts, from, how) => {
  const all = [parts, from, how];
  const expected = { codes: all.flatMap(({ codes }) => codes), sure: all.some(({ sure }) => sure) };
  const found = await outcomeOf(() => [...mergeVisible(loose(parts.make()), loose(from.make()), loose(how.make()))]);
  judge("mergeVisible", expected, found);
  if (!expected.sure) {
    const cloud = new PointCloud(parts.meaning);
    const whole = await outcomeOf(() => cloud.visibleFrom(from.meaning, how.meaning));
    cloud.dispose();
    agree(
      "mergeVisible",
      found,
      "answer" in whole ? { answer: (whole.answer as { indices: number[] }).indices } : whole,
    );
  }
});

/** Memory that a getter takes away while the parts are read. It can be the memory of any part. */
export const disappearingParts = fc.asyncProperty(
  fc.constantFrom("positions", "ids"),
  fc.nat({ max: 2 }),
  fc.nat({ max: 2 }),
  fc.boolean(),
  fc.constantFrom<TypeOf<Float32Array | Float64Array | Uint8Array>>(Float32Array, Float64Array, Uint8Array),
  async (what, victim, actor, shrinks, Type) => {
    const parts = [0, 1, 2].map((i) => ({ positions: memory(Type, 6).fill(i + 1), ids: memory(Uint32Array, 2) }));
    const act = () => {
      const { buffer } = parts[victim]![what];
      if (shrinks) {
        (buffer as unknown as { resize: (bytes: number) => void }).resize(0);
      } else {
        structuredClone(buffer, { transfer: [buffer as ArrayBuffer] });
      }
    };
    const given: unknown[] = [...parts];
    const { positions: own, ids } = parts[actor]!;
    given[actor] = {
      get positions() {
        act();
        return own;
      },
      ids,
    };
    const found = await outcomeOf(() => [...mergeVisible(loose(given), [9, 9, 9], { radius: 1e3 })]);
    // Memory that was copied before it went away is not missed.
    const copied = Type === Uint8Array && what === "positions" && victim < actor;
    const code = what === "positions" ? "positions-type" : "option";
    judge(`the ${what} of part ${victim}, taken away by part ${actor}`, { codes: [code], sure: !copied }, found);
  },
);

/** An array in a buffer that can shrink. */
function memory<T>(Type: TypeOf<T>, length: number): T {
  const bytes = Type.BYTES_PER_ELEMENT * length;
  const Resizable = ArrayBuffer as unknown as new (length: number, options: { maxByteLength: number }) => ArrayBuffer;
  return new Type(new Resizable(bytes, { maxByteLength: bytes }), 0, length);
}

interface TypeOf<T> {
  new (buffer: ArrayBuffer, start: number, length: number): T;
  BYTES_PER_ELEMENT: number;
}
