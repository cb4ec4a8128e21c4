import { HprError } from "./errors.js";

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
