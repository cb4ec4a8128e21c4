import { isWhole, numberReader } from "./numbers.js";
import { FormatProblem } from "./problem.js";
import { type Axes, type Field, hasLists, rowBytes } from "./rows.js";

/** The largest number of rows that are checked. */
export const ORDER_SAMPLE = 1000;

/**
 * Refuses rows in the wrong byte order. Such rows have many numbers that are far larger or smaller
 * than any measured number. In the other byte order, they have almost none.
 */
export function checkByteOrder(rows: DataView, fields: readonly Field[], axes: Axes, littleEndian: boolean): void {
  if (hasLists(fields)) return;
  const size = rowBytes(fields);
  const count = Math.min(ORDER_SAMPLE, Math.floor(rows.byteLength / size));
  const odd = (little: boolean) => {
    let number = 0;
    for (const axis of axes.filter((each) => !isWhole(fields[each]!.type))) {
      const read = numberReader(fields[axis]!.type, rowBytes(fields.slice(0, axis)), little);
      for (let row = 0; row < count; row++) if (isOdd(read(rows, row * size))) number++;
    }
    return number / (3 * count);
  };
  if (count === 0 || odd(littleEndian) < 0.3 || odd(!littleEndian) > 0.01) return;
  const other = littleEndian ? "big" : "little";
  throw new FormatProblem(`its numbers are ${other}-endian, but its header says the opposite`);
}

function isOdd(value: number): boolean {
  const size = Math.abs(value);
  return !(size < 1e15) || (size > 0 && size < 1e-20);
}
