import { HprError } from "./errors.js";

/** Runs an allocation in JavaScript's memory. If it is refused, the error is `too-large`. */
export function allocating<T>(what: string, allocate: () => T): T {
  try {
    return allocate();
  } catch (cause) {
    throw new HprError("too-large", `no memory for ${what}`, { cause });
  }
}
