import { HprError } from "hidden-point-removal";
import { LoadProblem } from "../loaders/protocol.ts";
import type { HiddenPointCloudError } from "./api.ts";

/** The error of an `error` event. */
export class Problem extends Error implements HiddenPointCloudError {
  override readonly name = "HiddenPointCloudError";
  readonly code: string;
  declare readonly attribute?: string;

  constructor(code: string, message: string, options: { attribute?: string; cause?: unknown } = {}) {
    super(message, "cause" in options ? { cause: options.cause } : {});
    this.code = code;
    if (options.attribute !== undefined) this.attribute = options.attribute;
  }
}

/** Makes a problem of the element from anything that was thrown. */
export function problemOf(thrown: unknown, name: string): Problem {
  if (thrown instanceof Problem) return thrown;
  if (thrown instanceof LoadProblem) return new Problem("source", thrown.message, { cause: thrown });
  const [code, message] = thrown instanceof HprError ? [thrown.code, thrown.message] : ["internal", String(thrown)];
  return new Problem(code, `${name} could not be shown: ${message.replace(/\.$/, "")}.`, { cause: thrown });
}
