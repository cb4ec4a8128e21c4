import type { LasHeader } from "./las.js";
import { FormatProblem } from "./problem.js";

/** The point formats that laz-perf supports. */
const LAZ_FORMATS = [0, 1, 2, 3, 6, 7, 8];

/** Refuses compressed points that laz-perf does not support. */
export function checkLazFormat({ format }: LasHeader): void {
  if (!LAZ_FORMATS.includes(format))
    throw new FormatProblem(`its compressed points have format ${format}, which laz-perf cannot decompress`);
}

/**
 * Refuses a compressed file that was cut. The table of its chunks is at its end, so that is missing then.
 *
 * @param read the bytes of a part of the file, fewer at its end
 */
export async function checkChunkTable(
  { start, count }: LasHeader,
  size: number,
  read: (from: number, to: number) => Promise<Uint8Array>,
): Promise<void> {
  const number = async (place: number) => {
    const part = await read(place, place + 8);
    return part.length < 8 ? undefined : new DataView(part.buffer, part.byteOffset, 8);
  };
  const first = Number((await number(start))?.getBigInt64(0, true) ?? 0);
  // A program that writes to a stream stores the table's place at the very end.
  const table = first === -1 ? Number((await number(size - 8))?.getBigInt64(0, true) ?? 0) : first;
  const head = table < start ? undefined : await number(table);
  if (head === undefined) throw lasEndsEarly(count);
  if (head.getUint32(4, true) > count) throw lazDamaged();
}

export function lasEndsEarly(count: number): FormatProblem {
  return new FormatProblem(`it ends before the ${count.toLocaleString("en-US")} points that its header promises`);
}

export function lazDamaged(): FormatProblem {
  return new FormatProblem("its compressed points cannot be decompressed");
}
