// Marks and the selection as parameters of the address. Points are named by their index in the cloud.
import { MARK_PARAMETERS, type MarkParameter } from "../settings/address.ts";
import type { Label } from "./label.ts";
import type { Measure } from "./measure.ts";
import type { Select } from "./select.ts";

/** The longest text of each parameter, in characters. Many programs cut an address after 2,000 or a little more. */
const LONGEST = 600;
const LONGEST_LABEL = 80;
const RADIX = 36;

/** The tools whose results are part of the address. */
export interface Marked {
  measure: Measure;
  label: Label;
  select: Select;
}

export interface Link {
  parameters: Record<MarkParameter, string[]>;
  /** The things that are too long for an address. */
  left: string[];
}

const SAID: Record<MarkParameter, string> = {
  measure: "the distances",
  label: "the labels",
  select: "the selection",
};

export function linkOf({ measure, label, select }: Marked): Link {
  const parameters: Link["parameters"] = {
    measure: measure.pairs.map((ends) => ends.join()),
    label: label.texts.map(({ index, text }) => `${index},${text}`),
    select: select.indices.length > 0 ? [gapsOf(select.indices)] : [],
  };
  const left: string[] = [];
  for (const name of MARK_PARAMETERS) {
    if (parameters[name].join("").length <= LONGEST) continue;
    parameters[name] = [];
    left.push(SAID[name]);
  }
  return { parameters, left };
}

/** Sets the marks of an address. Returns whether each of them has its points in a cloud of `count` points. */
export function restore(search: string, { measure, label, select }: Marked, count: number): boolean {
  const query = new URLSearchParams(search);
  let isWhole = true;
  const indexOf = (text: string | undefined) => {
    const index = /^\d{1,10}$/.test(text ?? "") ? Number(text) : count;
    return index < count ? index : null;
  };
  for (const text of query.getAll("measure").slice(0, LONGEST)) {
    const [from, to, more] = text.split(",");
    const ends = [indexOf(from), indexOf(to)] as const;
    if (ends[0] === null || ends[1] === null || more !== undefined) isWhole = false;
    else measure.measure(ends[0], ends[1]);
  }
  for (const text of query.getAll("label").slice(0, LONGEST)) {
    const comma = text.indexOf(",");
    const index = comma < 0 ? null : indexOf(text.slice(0, comma));
    const words = text.slice(comma + 1, comma + 1 + LONGEST_LABEL).trim();
    if (index === null || words === "") isWhole = false;
    else label.add(index, words);
  }
  const selected = query.get("select");
  const indices = selected === null ? null : indicesOf(selected, count);
  if (indices) select.choose(indices);
  else if (selected !== null) isWhole = false;
  return isWhole;
}

/**
 * Writes ascending indices as gaps, to base 36. Each gap is counted from the point after the last one. "gap-more"
 * stands for a point and so many points after it: "3-4.2" are 3, 4, 5, 6, 7 and 10. Ends when the text is longer than an
 * address takes.
 */
export function gapsOf(indices: Uint32Array): string {
  const parts: string[] = [];
  let next = 0;
  let length = 0;
  for (let i = 0; i < indices.length && length <= LONGEST + 1;) {
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
