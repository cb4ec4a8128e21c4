// A time counts only with the right answer. Every engine must give the same visible
// set and radius to the bit. A difference ends the run.
import type { Cloud } from "./clouds.js";
import type { Outcome, Task } from "./measure.js";

/** Compares each engine's answers with the first engine's. */
export function checkAnswers(cloud: Cloud, tasks: Task[], measured: ReadonlyMap<string, Outcome[]>): void {
  const [[reference, expected] = ["", []]] = measured;
  for (const [engine, outcomes] of measured) {
    tasks.forEach(({ exponent }, t) => {
      const where = `${cloud.name}, exponent ${exponent}`;
      const [ours, theirs] = [outcomes[t]!, expected[t]!];
      same(`${where}, cold: ${engine} and ${reference}`, summary(ours), summary(theirs));
    });
  }
}

function summary({ visible, radius, digest }: Outcome): string {
  return `${visible} visible (${digest}) with R = ${radius}`;
}

function same(what: string, a: string, b: string): void {
  if (a !== b) throw new WrongAnswer(`${what} differ: ${a} and ${b}`);
}

/** The library, or a peer, has answered wrongly. */
export class WrongAnswer extends Error {
  override name = "WrongAnswer";
}
