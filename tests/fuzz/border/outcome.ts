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
  if (typeof answer !== "object" || answer === null || !("indices" in answer)) {
    return answer instanceof Float32Array ? [...answer] : answer;
  }
  const { indices, count, radius, exponent, evaluations, inversion, triangles } = answer as Answer;
  const mask = (answer as Answer).mask();
  const seen = [...mask.keys()].filter((i) => mask[i] === 1);
  require(count === indices.length, "count is not the number of indices");
  require(seen.join() === indices.join(), "the mask is not that of the indices, or they do not ascend");
  require([radius, exponent, evaluations].every(
    (x) => Number.isFinite(x) && x >= 0,
  ), "a number of the answer is not finite");
  require(triangles === undefined || triangles.every((i) => mask[i] === 1), "a corner of a triangle is not visible");
  return {
    indices: [...indices],
    length: mask.length,
    radius,
    exponent,
    evaluations,
    inversion,
    ...(triangles && { triangles: [...triangles] }),
  };
}

interface Answer {
  indices: Uint32Array;
  count: number;
  radius: number;
  exponent: number;
  evaluations: number;
  inversion: unknown;
  triangles?: Uint32Array;
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

/** Checks that both outcomes have the same numbers, or that both are refused with the same code. */
export function agree(name: string, one: Outcome, other: Outcome): void {
  const words = [one, other].map((it) => ("refused" in it ? it.refused : JSON.stringify(it.answer)));
  require(words[0] === words[1], `${name}: ${words[0]} is not ${words[1]}`);
}
