// The outcome of a call, in a form that can be compared.
import { HprError } from "hidden-point-removal";

export type Outcome = { answer: unknown } | { refused: string; error: unknown };

/** The longest time that an answer may take, in milliseconds. The machine may do other work, too. */
const PATIENCE = 60_000;

/** Waits for an answer, but not longer than `PATIENCE`. */
export async function outcomeOf(call: () => unknown): Promise<Outcome> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => {
      reject(new Error(`no answer after ${PATIENCE / 1000} s`));
    }, PATIENCE);
  });
  try {
    return { answer: plain(await Promise.race([call(), late])) };
  } catch (error) {
    return { refused: codeOf(error), error };
  } finally {
    clearTimeout(timer);
  }
}

/** A stable code, `AbortError`, or a description of any other error. */
function codeOf(error: unknown): string {
  if (error instanceof HprError) {
    return error.code;
  }
  if (error instanceof DOMException && error.name === "AbortError") {
    return error.name;
  }
  return `a foreign error: ${String(error)}`;
}

/** Only the numbers of an answer. Also checks that they do not contradict each other. */
function plain(answer: unknown): unknown {
  if (typeof answer !== "object" || answer === null || !("mask" in answer && "indices" in answer)) {
    return answer instanceof Float32Array ? [...answer] : answer;
  }
  const { indices, count, radius, exponent, evaluations, inversion, exact } = answer as Answer;
  const { triangles, scores, pixels, depths } = answer as Answer;
  const mask = (answer as Answer).mask();
  const seen = [...mask.keys()].filter((i) => mask[i] === 1);
  require(count === indices.length, "count is not the number of indices");
  require(seen.join() === indices.join(), "the mask is not that of the indices, or they do not ascend");
  require([radius, exponent, evaluations].every(
    (x) => Number.isFinite(x) && x >= 0,
  ), "a number of the answer is not finite");
  require(triangles === undefined || triangles.every((i) => mask[i] === 1), "a corner of a triangle is not visible");
  require(scores === undefined || scores.length === mask.length, "there is not one score for each index");
  require(pixels === undefined || pixels.length === 2 * count, "there is not one pixel for each visible point");
  require(depths === undefined || depths.length === count, "there is not one depth for each visible point");
  return {
    indices: [...indices],
    length: mask.length,
    radius,
    exponent,
    evaluations,
    inversion,
    exact,
    ...(triangles && { triangles: [...triangles] }),
    ...(scores && { scores: [...scores] }),
    ...(pixels && { pixels: [...pixels] }),
    ...(depths && { depths: [...depths] }),
  };
}

interface Answer {
  indices: Uint32Array;
  count: number;
  radius: number;
  exponent: number;
  evaluations: number;
  inversion: unknown;
  exact: boolean;
  triangles?: Uint32Array;
  scores?: Float32Array;
  pixels?: Float32Array;
  depths?: Float32Array;
  mask(): Uint8Array;
}

export function require(holds: boolean, what: string): asserts holds {
  if (!holds) {
    throw new Error(what);
  }
}

/** Checks that a call is refused if it must be, and only with one of the codes. */
export function judge(
  name: string,
  { codes, sure }: { codes: readonly string[]; sure: boolean },
  found: Outcome,
): void {
  if ("refused" in found) {
    const said = found.error instanceof Error ? found.error.message : "";
    require(codes.includes(
      found.refused,
    ), `${name} was refused as ${found.refused} (${said}), not as ${codes.join(" or ")}`);
    require(said.length > 0 && said.length < 2000, `${name} was refused with a message of length ${said.length}`);
  } else {
    require(!sure, `${name} was answered, not refused as ${codes.join(" or ")}`);
  }
}

/** Checks that both outcomes have the same bits, or that both are refused with the same code. */
export function agree(name: string, one: Outcome, other: Outcome): void {
  requireSame(
    name,
    ...([one, other].map((it) => ("refused" in it ? it.refused : bits(it.answer))) as [string, string]),
  );
}

/** Checks that both outcomes have the same bits, or that both are refused with the same code and message. */
export function agreeInWords(name: string, one: Outcome, other: Outcome): void {
  const words = [one, other].map((it) => {
    if (!("refused" in it)) return bits(it.answer);
    require(it.error instanceof HprError, `${name} was refused by ${String(it.error)}`);
    return `${it.refused}: ${it.error.message}`;
  });
  requireSame(name, ...(words as [string, string]));
}

function requireSame(name: string, one: string, other: string): void {
  require(one === other, `${name}: ${one} is not ${other}`);
}

/** Text that is the same only for the same bits. JSON alone writes −0 as 0, and NaN and infinite numbers as null. */
function bits(answer: unknown): string {
  return JSON.stringify(answer, (_, value: unknown) =>
    typeof value === "number" && (!Number.isFinite(value) || Object.is(value, -0))
      ? `${Object.is(value, -0) ? "-" : ""}${value}`
      : value,
  );
}
