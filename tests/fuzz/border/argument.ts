// Arguments that hold numbers in every form, and values that hold none.
import fc from "fast-check";

/** An argument, and what it means in plain numbers. `make` makes a new one for every call, because a call may use it up. */
export interface Argument<Meaning> {
  name: string;
  make: () => unknown;
  meaning: Meaning;
}

/** Makes the report of a failed case print the name of the argument. */
export function named<T extends { name: string }>(arbitrary: fc.Arbitrary<T>): fc.Arbitrary<T> {
  return arbitrary.map((argument) => Object.assign(argument, { [fc.toStringMethod]: () => argument.name }));
}

/** Values that are neither arrays, nor options, nor numbers that mean anything. */
export const JUNK: [name: string, make: () => unknown][] = [
  ["undefined", () => undefined],
  ["null", () => null],
  ["true", () => true],
  ["a number", () => 7],
  ["a BigInt", () => 7n],
  ["a symbol", () => Symbol("junk")],
  ["a string", () => "1,2,3"],
  ["a long string", () => "x".repeat(100_000)],
  ["a function", () => () => 0],
  ["a Map", () => new Map([[0, 1]])],
  ["a DataView", () => new DataView(new ArrayBuffer(24))],
  ["an ArrayBuffer", () => new ArrayBuffer(24)],
  ["BigInts", () => new BigInt64Array(6)],
  ["unsigned BigInts", () => new BigUint64Array(6)],
  ["a negative length", () => ({ length: -3 })],
  ["a broken length", () => ({ length: 1.5 })],
  ["a length of NaN", () => ({ length: NaN })],
  ["a length that is a string", () => ({ length: "3", 0: 1, 1: 1, 2: 1 })],
  ["a date", () => new Date(0)],
  ["a promise", () => Promise.resolve([1, 2, 3])],
  ["an error", () => new Error("junk")],
];

const TYPED_ARRAYS = [
  Int8Array,
  Uint8Array,
  Uint8ClampedArray,
  Int16Array,
  Uint16Array,
  Int32Array,
  Uint32Array,
  Float32Array,
  Float64Array,
] as const;

type NumberArray = InstanceType<(typeof TYPED_ARRAYS)[number]>;
type Dress = [
  name: string,
  put: (numbers: readonly number[]) => unknown,
  holds: (numbers: readonly number[]) => boolean,
];

class OwnClass extends Float64Array {
  static get [Symbol.species](): Float64ArrayConstructor {
    return Array as never;
  }
  override get [Symbol.toStringTag](): "Float64Array" {
    return "OwnClass" as never;
  }
}

export const typed = (Type: (typeof TYPED_ARRAYS)[number], numbers: readonly number[]): NumberArray =>
  Type.from(numbers as number[]);

const always = () => true;
const likeArray = (numbers: readonly number[]) => Object.assign({ length: numbers.length }, numbers);

/** Ways to hand over the same numbers. */
const DRESSES: Dress[] = [
  ["an array", (numbers) => [...numbers], always],
  ...TYPED_ARRAYS.map((Type): Dress => [
    Type.name,
    (numbers) => typed(Type, numbers),
    (numbers) => numbers.every((x) => Object.is(typed(Type, [x])[0], x)),
  ]),
  ["an object like an array", likeArray, always],
  ["a frozen array", (numbers) => Object.freeze([...numbers]), always],
  ["a proxy of an array", (numbers) => new Proxy([...numbers], {}), always],
  ["a class of its own", (numbers) => OwnClass.from(numbers), always],
  [
    "shared memory",
    (numbers) => {
      const shared = new Float64Array(new SharedArrayBuffer(8 * numbers.length));
      shared.set(numbers);
      return shared;
    },
    always,
  ],
  [
    "the middle of a buffer",
    (numbers) => {
      const all = new Float64Array(numbers.length + 5).fill(NaN);
      all.set(numbers, 2);
      return all.subarray(2, 2 + numbers.length);
    },
    always,
  ],
  [
    "a buffer that can grow",
    (numbers) => {
      const view = growing(8 * numbers.length, 8 * numbers.length + 64);
      view.set(numbers);
      return view;
    },
    always,
  ],
];

/** A view that follows the length of its buffer. */
export function growing(bytes: number, most: number): Float64Array {
  const Resizable = ArrayBuffer as unknown as new (length: number, options: { maxByteLength: number }) => ArrayBuffer;
  return new Float64Array(new Resizable(bytes, { maxByteLength: most }));
}

/** Numbers in every form that may hold them. */
export function dressed(numbers: readonly number[]): fc.Arbitrary<Argument<readonly number[]>> {
  const fitting = DRESSES.filter(([, , holds]) => holds(numbers));
  return named(
    fc.constantFrom(...fitting).map(([dress, put]) => ({
      name: `${dress} of [${numbers.join(", ")}]`,
      make: () => put(numbers),
      meaning: numbers,
    })),
  );
}

export function transferredAway<T extends ArrayBufferView>(view: T): T {
  structuredClone(view, { transfer: [view.buffer as ArrayBuffer] });
  return view;
}
