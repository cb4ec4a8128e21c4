// Ascending indices as a short text.

const RADIX = 36;

/**
 * Writes ascending indices as gaps, to base 36. Each gap is counted from the point after the last one. "gap-more"
 * stands for a point and so many points after it: "3-4.2" are 3, 4, 5, 6, 7 and 10. Ends when the text
 * is longer than `longest` characters.
 */
export function gapsOf(indices: Uint32Array, longest: number): string {
  const parts: string[] = [];
  let next = 0;
  let length = 0;
  for (let i = 0; i < indices.length && length <= longest + 1;) {
    const first = indices[i]!;
    let run = 1;
    while (indices[i + run] === first + run) run++;
    const part = (first - next).toString(RADIX) + (run > 1 ? `-${(run - 1).toString(RADIX)}` : "");
    parts.push(part);
    length += part.length + 1;
    next = first + run;
    i += run;
  }
  return parts.join(".");
}

/** Reads indices that `gapsOf` has written. `null`: it is something else, or the cloud has too few points. */
export function indicesOf(text: string, count: number): Uint32Array | null {
  const found: number[] = [];
  let next = 0;
  for (const part of text.split(".")) {
    const [, gap, more = "0"] = /^([\da-z]{1,7})(?:-([\da-z]{1,7}))?$/.exec(part) ?? [];
    if (gap === undefined) return null;
    const first = next + Number.parseInt(gap, RADIX);
    next = first + Number.parseInt(more, RADIX) + 1;
    if (next > count) return null;
    for (let index = first; index < next; index++) found.push(index);
  }
  return Uint32Array.from(found);
}
