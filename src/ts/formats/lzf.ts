import { FormatProblem } from "./problem.js";

/** Unpacks LZF, the compression of PCD files. It has runs of plain bytes, and copies from up to 8 kB back. */
export function unpackLzf(packed: Uint8Array, length: number): Uint8Array<ArrayBuffer> {
  // Three bytes unpack to 264 bytes at most.
  if (length > 88 * packed.length) throw damaged();
  const unpacked = new Uint8Array(length);
  let [from, to] = [0, 0];
  while (from < packed.length) {
    const control = packed[from++]!;
    if (control < 32) {
      const run = packed.subarray(from, from + control + 1);
      if (run.length <= control || to + run.length > length) throw damaged();
      unpacked.set(run, to);
      from += run.length;
      to += run.length;
      continue;
    }
    let count = (control >> 5) + 2;
    if (count === 9) count += packed[from++] ?? NaN;
    const back = ((control & 31) << 8) + (packed[from++] ?? NaN) + 1;
    if (!(back <= to && to + count <= length)) throw damaged();
    // Bytes are copied one by one, because a copy may repeat bytes that it has just written.
    for (let i = 0; i < count; i++, to++) unpacked[to] = unpacked[to - back]!;
  }
  if (to !== length) throw damaged();
  return unpacked;
}

function damaged(): FormatProblem {
  return new FormatProblem("its compressed data is damaged");
}
