import { HprError, type HprErrorCode } from "../base/errors.js";

/**
 * A refusal as the wasm throws it (src/wasm/answer.rs). The numbers are written here, because that would make the wasm
 * larger.
 */
interface Failure {
  code: HprErrorCode;
  /** The message. Each `@` in it stands for a word, and each `#` for a number. */
  text: string;
  first: string;
  second: string;
  numbers: number[];
}

/**
 * The error of a refusal by the bindings, which have freed their memory by then. Undefined for any
 * other thrown value.
 */
export function refusal(thrown: unknown): HprError | undefined {
  if (!isFailure(thrown)) {
    return undefined;
  }
  const { code, text, first, second, numbers } = thrown;
  const [words, values] = [[first, second], numbers.map(spelled)];
  return new HprError(
    code,
    text.replace(/[@#]/g, (mark) => (mark === "@" ? words : values).shift()!),
  );
}

/** The number as the crate writes it. JavaScript writes only these cases differently. */
function spelled(number: number): string {
  if (Object.is(number, -0)) {
    return "-0";
  }
  return String(number).replace("Infinity", "infinity").replace("e+", "e");
}

function isFailure(thrown: unknown): thrown is Failure {
  return (
    typeof thrown === "object" &&
    thrown !== null &&
    !(thrown instanceof Error) &&
    "code" in thrown &&
    "text" in thrown &&
    "numbers" in thrown
  );
}
