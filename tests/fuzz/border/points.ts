// Positions and viewpoints, good and bad.
import fc from "fast-check";
import { type Argument, bad, dressed, good, growing, JUNK, named, transferredAway } from "./argument.js";

/** Small whole numbers. Every typed array holds them. Many points coincide, or lie on one line or in one plane. */
const coordinate = fc.integer({ min: 0, max: 6 });
const anywhere = fc.oneof(
  { weight: 4, arbitrary: coordinate },
  { weight: 1, arbitrary: fc.double({ noNaN: true, min: -9, max: 9 }) },
);

export function coordinates(dimension: number, most: number): fc.Arbitrary<number[]> {
  const point = fc.array(anywhere, { minLength: dimension, maxLength: dimension });
  return fc.array(point, { maxLength: most }).map((points) => points.flat());
}

/** Positions of a cloud of this dimension and stride. */
export function positions(
  dimension: number,
  stride: number,
  skips: boolean,
  most = 30,
): fc.Arbitrary<Argument<readonly number[]>> {
  const numbers = coordinates(stride, most);
  const spoiled = fc
    .tuple(
      fc.array(anywhere, { minLength: stride, maxLength: 5 * stride }),
      fc.nat(),
      fc.constantFrom(NaN, Infinity, -Infinity),
    )
    .map(([list, at, wrong]) => {
      const whole = list.slice(0, list.length - (list.length % stride));
      whole[at % whole.length] = wrong;
      return { whole, counts: (at % whole.length) % stride < dimension };
    })
    .map(({ whole, counts }) =>
      skips || !counts
        ? good(`[${whole.join(", ")}]`, whole)
        : bad("non-finite", `[${whole.join(", ")}]`, () => whole, whole),
    );
  const uneven = fc
    .tuple(numbers, fc.integer({ min: 1, max: stride - 1 }))
    .chain(([list, more]) => dressed([...list, ...Array<number>(more).fill(1)]))
    .map(({ name, make }) => bad<readonly number[]>("positions-length", name, make, []));
  return named(
    fc.oneof(
      { weight: 12, arbitrary: numbers.chain(dressed) },
      { weight: 2, arbitrary: spoiled },
      { weight: 2, arbitrary: uneven },
      { weight: 3, arbitrary: fc.constantFrom(...badPositions(stride)) },
    ),
  );
}

function badPositions(stride: number): Argument<readonly number[]>[] {
  const element = (name: string, value: unknown) =>
    bad<readonly number[]>("positions-type", name, () => Array<unknown>(stride).fill(value), []);
  return [
    ...JUNK.map(([name, make]) => bad<readonly number[]>("positions-type", name, make, [])),
    element("strings", "1"),
    element("BigInts in an array", 1n),
    element("nested arrays", [1, 2, 3]),
    element("nulls", null),
    element("objects that are numbers", { valueOf: () => 1 }),
    bad("positions-type", "holes", () => new Array<number>(stride), []),
    bad("positions-type", "transferred away", () => transferredAway(new Float32Array(2 * stride)), []),
    bad("positions-type", "integers transferred away", () => transferredAway(new Uint16Array(2 * stride)), []),
    bad("positions-type", "cut off", cutOff, []),
    bad("too-large", "too many", () => ({ length: stride * 2 ** 29 }), []),
    bad("too-large", "a length beyond all arrays", () => ({ length: stride * 2 ** 40 }), []),
  ];
}

/** A view that reaches beyond the end of its buffer, because the buffer was made smaller. */
function cutOff(): Float64Array {
  const { buffer } = growing(96, 96);
  const view = new Float64Array(buffer, 48, 6);
  (buffer as unknown as { resize: (bytes: number) => void }).resize(56);
  return view;
}

/** A viewpoint. Some are so far away that distances overflow: these may be refused with `radius`. */
export function viewpoint(dimension: number): fc.Arbitrary<Argument<readonly number[]>> {
  const place = fc.array(fc.oneof(anywhere, fc.integer({ min: -20, max: 20 })), {
    minLength: dimension,
    maxLength: dimension,
  });
  const wrongLength = fc
    .array(anywhere, { maxLength: 2 * dimension })
    .filter(({ length }) => length !== dimension)
    .map((list) => bad<readonly number[]>("viewpoint", `[${list.join(", ")}]`, () => list, []));
  const notFinite = fc
    .tuple(
      place,
      fc.nat({ max: dimension - 1 }),
      fc.constantFrom(NaN, Infinity, -Infinity, "1", null, 1n, undefined, [1]),
    )
    .map(([list, at, wrong]) => {
      const spoiled = list.map((x, i) => (i === at ? wrong : x));
      return bad<readonly number[]>("viewpoint", `with ${String(wrong)}`, () => spoiled, []);
    });
  const huge = place.map((list): Argument<readonly number[]> => {
    const far = list.map((x, i) => (i === 0 ? 1e200 : x));
    return { ...good(`[${far.join(", ")}]`, far), codes: ["radius"] };
  });
  const junk = fc.constantFrom(...JUNK.map(([name, make]) => bad<readonly number[]>("viewpoint", name, make, [])));
  return named(
    fc.oneof(
      { weight: 12, arbitrary: place.chain(dressed) },
      { weight: 1, arbitrary: wrongLength },
      { weight: 1, arbitrary: notFinite },
      { weight: 1, arbitrary: huge },
      { weight: 1, arbitrary: junk },
    ),
  );
}

/** A list of viewpoints. It is good only if each viewpoint is good. */
export function viewpoints(dimension: number): fc.Arbitrary<Argument<readonly (readonly number[])[]>> {
  const list = fc
    .array(viewpoint(dimension), { maxLength: 4 })
    .map((all): Argument<readonly (readonly number[])[]> => ({
      name: `[${all.map(({ name }) => name).join("; ")}]`,
      make: () => all.map(({ make }) => make()),
      codes: all.flatMap(({ codes }) => codes),
      sure: all.some(({ sure }) => sure),
      meaning: all.map(({ meaning }) => meaning),
    }));
  const junk = fc.constantFrom(
    ...JUNK.map(([name, make]) => bad<readonly (readonly number[])[]>("viewpoint", name, make, [])),
  );
  return named(fc.oneof({ weight: 8, arbitrary: list }, { weight: 1, arbitrary: junk }));
}
