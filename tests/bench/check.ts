// A time counts only with the right answer. Every engine must give the same visible
// set and radius to the bit, cold and moving. A difference ends the run.
import type { Cloud } from "./clouds.js";
import type { Outcome, Task } from "./measure.js";
import { STEPS } from "./views.js";

/** Compares each engine's answers with the first engine's, and its moving answers with its cold answers. */
export function checkAnswers(cloud: Cloud, tasks: Task[], measured: ReadonlyMap<string, Outcome[]>): void {
  const [[reference, expected] = ["", []]] = measured;
  for (const [engine, outcomes] of measured) {
    tasks.forEach(({ exponent }, t) => {
      const where = `${cloud.name}, exponent ${exponent}`;
      const [ours, theirs] = [outcomes[t]!, expected[t]!];
      same(`${where}, cold: ${engine} and ${reference}`, summary(ours), summary(theirs));
      ours.paths.forEach((path, p) => {
        path.moving.forEach(({ digest }, view) => {
          const step = `${where}, view ${view + 1} of the motion by ${STEPS[p]!}°`;
          same(`${step}: ${engine} moving and cold`, digest, path.cold[view]!.digest);
          same(`${step}: ${engine} and ${reference}`, digest, theirs.paths[p]!.cold[view]!.digest);
        });
      });
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
