// Values that somebody may hand over by mistake or on purpose, wherever an argument is read.
import { growing, JUNK, transferredAway } from "./argument.js";
import { CAMERAS } from "./table.js";

/** What a hostile value throws by itself. It is passed on unchanged. */
class Own extends RangeError {}

export function throwing(): never {
  throw new Own("the argument's own");
}

/**
 * Whether a value itself threw: its own error, or what JavaScript says about a proxy that was revoked and a class that
 * is called as a listener.
 */
export const isOwn = (error: unknown): boolean =>
  error instanceof Own || (error instanceof TypeError && /revoked|requires 'new'/.test(error.message));

const NUMBERS = [NaN, Infinity, -Infinity, -1, -0, 0, 0.5, 5e-324, 1.7e308, 2 ** 53, 2 ** 32, 2 ** 31, 1e15];
const STRINGS = ["", "__proto__", "7", "\ud800", "opposite", "auto"];

function revoked(): unknown {
  const { proxy, revoke } = Proxy.revocable([1, 2, 3], {});
  revoke();
  return proxy;
}

function round(): unknown {
  const value: Record<string, unknown> = { x: 1, y: 2, z: 3 };
  value["self"] = value;
  return value;
}

function cut(): unknown {
  const view = growing(24, 48);
  (view.buffer as unknown as { resize(length: number): void }).resize(0);
  return view;
}

function* endless(): Generator<number> {
  for (;;) yield 1;
}

const handler = { get: throwing, ownKeys: throwing, has: throwing, getPrototypeOf: throwing };

export const HOSTILE: [name: string, make: () => unknown][] = [
  ...JUNK,
  ...[...NUMBERS, ...STRINGS].map((value): [string, () => unknown] => [JSON.stringify(value), () => value]),
  ["false", () => false],
  ["an empty array", () => []],
  ["an array of nothing", () => [undefined, null]],
  ["strings", () => ["1", "2", "3"]],
  ["arrays of arrays", () => [revoked, [[[[]]]], {}]],
  ["numbers in boxes", () => [1, 2, 3].map(Object) as unknown[]],
  ["infinite numbers", () => [1, Infinity, NaN]],
  ["an array as long as one can be", () => Array<unknown>(2 ** 32 - 1)],
  ["a length of 10¹⁵", () => ({ length: 1e15 })],
  ["a length of 2³²", () => ({ length: 2 ** 32, 0: 1 })],
  ["a length that throws", () => Object.defineProperty({}, "length", { get: throwing })],
  ["a getter that throws", () => Object.defineProperty({ y: 1, z: 1 }, "x", { get: throwing, enumerable: true })],
  ["a proxy that throws", () => new Proxy({}, handler)],
  ["a revoked proxy", revoked],
  ["an object that holds itself", round],
  ["an empty object", () => ({})],
  ["an object without a prototype", () => Object.create(null) as unknown],
  ["an object that is no number", () => ({ valueOf: throwing, toString: throwing, [Symbol.toPrimitive]: throwing })],
  ["a signal that is none", () => ({ aborted: false })],
  ["memory that is gone", () => transferredAway(new Float64Array(3))],
  ["memory that is cut off", cut],
  ["bytes", () => Uint8Array.of(1, 2, 3)],
  ["doubles", () => Float64Array.of(1, 2, 3, NaN)],
  ["shared memory", () => new Float64Array(new SharedArrayBuffer(24))],
  ["a class", () => Uint8Array],
  ["an iterable that never ends", endless],
  ["an iterator that throws", () => ({ [Symbol.iterator]: throwing })],
  ["a promise that is refused", () => ({ then: throwing })],
  ["a Blob", () => new Blob(["1 2 3\n"])],
  ["a URL", () => new URL("file:///nowhere")],
  ["a camera", () => ({ ...structuredClone(CAMERAS[0]), model: "FOV", distortion: [9] })],
];
