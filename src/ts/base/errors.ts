/** The stable short names of all errors. */
export type HprErrorCode =
  | "positions-length"
  | "positions-type"
  | "non-finite"
  | "viewpoint"
  | "radius"
  | "option"
  | "too-large"
  | "not-initialised"
  | "load"
  | "disposed"
  | "internal";

/**
 * The one error type of this package. Branch on {@link HprError.code}. The message is for people
 * and contains the refused value. If an argument's own getter or a proxy throws while it is read,
 * that error is passed on unchanged.
 *
 * | code | when |
 * |---|---|
 * | `positions-length` | the length is not a multiple of the stride |
 * | `positions-type` | not a typed array of numbers or an array of numbers, or transferred away; BigInt and 16-bit float arrays are refused |
 * | `non-finite` | NaN or an infinity among the positions |
 * | `viewpoint` | not three finite numbers (as many as the dimension); a direction that is zero |
 * | `radius` | not finite, not positive, smaller than the farthest distance, or overflowing |
 * | `option` | unknown, out of range, or excluding another one |
 * | `too-large` | more points than supported, or memory refused; everything else goes on working |
 * | `not-initialised` | a synchronous call before `init()` has resolved |
 * | `load` | the wasm (or the worker) could not be fetched, compiled or started; an octree that cannot be fetched, is broken or has changed |
 * | `disposed` | use after `dispose()`, or of an answer whose `indices` were given away |
 * | `internal` | a trap inside the wasm, or a worker that died |
 */
export class HprError extends Error {
  override readonly name = "HprError";
  /** The stable short name of the error. */
  readonly code: HprErrorCode;

  /** An error with one of the codes above, a sentence for people, and what caused it. */
  constructor(code: HprErrorCode, message: string, options?: { cause?: unknown }) {
    super(message, options);
    this.code = code;
  }
}

/** The value of `read`, whose errors say which argument they are about. */
export function naming<T>(argument: string | undefined, read: () => T): T {
  try {
    return read();
  } catch (cause) {
    if (argument === undefined || !(cause instanceof HprError)) throw cause;
    throw new HprError(cause.code, `${argument}: ${cause.message}`, { cause });
  }
}

/** Any thrown value as an error. */
export function asError(thrown: unknown): Error {
  return thrown instanceof Error ? thrown : new Error(String(thrown));
}

/** A refused value for a message. */
export function describe(value: unknown): string {
  switch (typeof value) {
    case "string":
      return JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}…` : value);
    case "bigint":
      return `${value}n`;
    case "number":
    case "boolean":
    case "undefined":
    case "symbol":
      return String(value);
    case "object":
      return value === null ? "null" : `an object of type ${typeTag(value)}`;
    default:
      return `a ${typeof value}`;
  }
}

/**
 * The built-in type of a value, such as `"Float32Array"`. Unlike `instanceof`, this also recognizes
 * values from another frame or context.
 */
export function typeTag(value: unknown): string {
  try {
    return Object.prototype.toString.call(value).slice("[object ".length, -1);
  } catch {
    // The value is a revoked proxy, or its tag throws.
    return "unknown";
  }
}

/** Runs an allocation in JavaScript's memory. If it is refused, the error is `too-large`. */
export function allocating<T>(what: string, allocate: () => T): T {
  try {
    return allocate();
  } catch (cause) {
    throw new HprError("too-large", `no memory for ${what}`, { cause });
  }
}

/** The positions of several parts, one after another: x, y, z of each point. */
export function concatenated(parts: readonly (Float32Array | Float64Array)[]): Float64Array<ArrayBuffer> {
  const length = parts.reduce((sum, part) => sum + part.length, 0);
  const positions = allocating(`${length / 3} points`, () => new Float64Array(length));
  let at = 0;
  for (const part of parts) {
    positions.set(part, at);
    at += part.length;
  }
  return positions;
}
