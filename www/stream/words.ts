import type { StreamStep } from "./protocol.ts";

const number = new Intl.NumberFormat("en-US");
const counted = (count: number, one: string, more = `${one}s`) => `${number.format(count)} ${count === 1 ? one : more}`;

/** A step in words. `isLast`: whether no more nodes will be read. */
export function sentenceOfStep(
  { positions, exact, nodes, points }: StreamStep,
  total: number,
  isLast: boolean,
): string {
  const count = positions.length / 3;
  const seen = `${number.format(count)} of ${counted(total, "point")} can be seen from here`;
  const read = `${counted(nodes.read, "node")} with ${counted(points, "point")} ${nodes.read === 1 ? "was" : "were"} read`;
  const hidden = `${number.format(nodes.hidden)} more ${nodes.hidden === 1 ? "is" : "are"} hidden`;
  if (exact) return `${seen}, exactly: ${read}, ${hidden}.`;
  if (isLast) {
    return `${seen}: not exact, ${counted(nodes.undecided, "node")} undecided, since there is no room for more; ${read}, ${hidden}.`;
  }
  return `${seen} so far: ${read}, ${hidden}.`;
}

/** The answer about the overview in words. */
export function sentenceOfOverview(count: number, shown: number, total: number): string {
  return `${number.format(count)} of the ${counted(shown, "point")} of the coarser levels can be seen from here; the file has ${counted(total, "point")}.`;
}

/** Why only the overview answers. */
export const ONLY_OVERVIEW =
  "This answer is about the coarser levels alone. The other levels are read only without an exponent.";
