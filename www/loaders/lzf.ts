/** Unpacks LZF, with which PCD files are compressed; three's PCDLoader keeps its own to itself. Null if the data is broken. */
export function unpackLzf(packed: Uint8Array, length: number): Uint8Array<ArrayBuffer> | null {
  const plain = new Uint8Array(length);
  let from = 0;
  let to = 0;
  while (from < packed.length) {
    const control = packed[from++]!;
    if (control < 32) {
      // A run of bytes as they are.
      const run = control + 1;
      if (from + run > packed.length || to + run > length) return null;
      plain.set(packed.subarray(from, from + run), to);
      from += run;
      to += run;
      continue;
    }
    // A run that has been there before, so many bytes ago; it may overlap with itself.
    let run = control >> 5;
    if (run === 7) run += packed[from++] ?? 0;
    run += 2;
    const back = to - ((control & 31) << 8) - (packed[from++] ?? 0) - 1;
    if (from > packed.length || back < 0 || to + run > length) return null;
    for (let i = 0; i < run; i++) plain[to + i] = plain[back + i]!;
    to += run;
  }
  return to === length ? plain : null;
}
