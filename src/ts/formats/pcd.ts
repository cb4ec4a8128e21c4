import { axesOf, type ChosenColumns } from "./axes.js";
import { countIn, type NumberType } from "./numbers.js";
import { endsEarly, FormatProblem, lineProblem } from "./problem.js";
import { unpackLzf } from "./lzf.js";
import { type Axes, type Field, type Group, rowBytes } from "./rows.js";
import { headerLines, type Line, restSays, wordsOf } from "./text.js";

/** The largest size of a PCD header in bytes. */
export const LONGEST_PCD_HEADER = 1 << 16;

export interface PcdHeader {
  data: "ascii" | "binary" | "binary_compressed";
  points: Group;
  axes: Axes;
  /** The number of rows if the points are an image. Otherwise, it is 1. */
  height: number;
  /** The place from which the points were measured, if the header has it. */
  viewpoint: readonly [number, number, number] | undefined;
  lines: readonly Line[];
  /** The end of the header, in bytes. */
  end: number;
}

const KEYWORDS = ["VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS", "DATA"];
const KINDS: Record<string, string> = { F: "float", I: "int", U: "uint" };

/** The lines of the header by their keywords. */
type Entries = ReadonlyMap<string, Line & { words: readonly string[] }>;

/** @param start the file's bytes, or the first LONGEST_PCD_HEADER of them */
export function readPcdHeader(start: Uint8Array, chosen?: ChosenColumns): PcdHeader {
  const entries = new Map<string, Line & { words: readonly string[] }>();
  const lines: Line[] = [];
  for (const line of headerLines(start.subarray(0, LONGEST_PCD_HEADER))) {
    const { text, number } = line;
    lines.push(line);
    if (text === "" || text.startsWith("#")) continue;
    const [keyword, ...words] = wordsOf(text);
    // COLUMNS is an old name of FIELDS.
    const known = keyword!.toUpperCase().replace(/^COLUMNS$/, "FIELDS");
    if (!KEYWORDS.includes(known)) throw lineProblem(number, "is not a line of a PCD header", text);
    if (entries.has(known)) throw lineProblem(number, "stands in the PCD header a second time", text);
    entries.set(known, { ...line, words });
    if (known !== "DATA") continue;
    const data = words.join(" ").toLowerCase();
    if (data !== "ascii" && data !== "binary" && data !== "binary_compressed") {
      throw lineProblem(number, "gives PCD data that is none of ascii, binary and binary_compressed", text);
    }
    const fields = fieldsIn(entries);
    const { count, height } = countsIn(entries);
    const axes = axesIn(fields, chosen);
    const points = { name: "points", count, fields };
    return { data, points, axes, height, viewpoint: viewpointIn(entries), lines, end: line.end };
  }
  throw new FormatProblem("its PCD header has no end");
}

function fieldsIn(entries: Entries): Field[] {
  const names = entry(entries, "FIELDS").words;
  const [sizes, types, counts] = ["SIZE", "TYPE", "COUNT"].map((keyword) => {
    if (keyword === "COUNT" && !entries.has(keyword)) return names.map(() => "1");
    const { words, number, text } = entry(entries, keyword);
    if (words.length !== names.length) {
      throw lineProblem(number, `has ${words.length} values for ${names.length} fields`, text);
    }
    return words;
  });
  return names.map((name, i) => {
    // Fields called _ are padding between other fields, so there may be several.
    if (name !== "_" && names.indexOf(name) < i) {
      throw lineProblem(entry(entries, "FIELDS").number, `names ${name} twice`);
    }
    const [size, count] = [countIn(sizes![i]), countIn(counts![i])];
    const type = `${KINDS[types![i]!.toUpperCase()] ?? "?"}${8 * (size ?? NaN)}`;
    if (!/^(float(32|64)|u?int(8|16|32|64))$/.test(type)) {
      throw lineProblem(
        entry(entries, "SIZE").number,
        `gives ${name} a size that its type does not have`,
        `${types![i]!} ${sizes![i]!}`,
      );
    }
    if (count === undefined || count === 0) {
      throw lineProblem(entry(entries, "COUNT").number, `does not say how many numbers ${name} is`, counts![i]);
    }
    return { name, type: type as NumberType, count };
  });
}

function axesIn(fields: readonly Field[], chosen?: ChosenColumns): Axes {
  const axes = axesOf(
    fields.map(({ name }) => name),
    chosen,
  );
  const several = axes.map((axis) => fields[axis]!).find(({ count }) => count > 1);
  if (several) throw new FormatProblem(`the ${several.name} of its points is ${several.count} numbers`);
  return axes;
}

function countsIn(entries: Entries): { count: number; height: number } {
  const [points, width, height] = ["POINTS", "WIDTH", "HEIGHT"].map((keyword) => {
    const found = entries.get(keyword);
    if (found === undefined) return undefined;
    const count = found.words.length === 1 ? countIn(found.words[0]) : undefined;
    if (count === undefined) throw lineProblem(found.number, "is not a number of points", found.text);
    return count;
  });
  const product = width === undefined ? undefined : width * (height ?? 1);
  const count = points ?? product;
  if (count === undefined || !Number.isSafeInteger(count)) {
    throw new FormatProblem("its PCD header does not say how many points there are");
  }
  if (product !== undefined && product !== count) {
    throw lineProblem(
      entry(entries, "POINTS").number,
      `does not give WIDTH times HEIGHT, ${product}`,
      `POINTS ${count}`,
    );
  }
  return { count, height: height ?? 1 };
}

function viewpointIn(entries: Entries): PcdHeader["viewpoint"] {
  const numbers = entries.get("VIEWPOINT")?.words.slice(0, 3).map(Number) ?? [];
  return numbers.length === 3 && numbers.every(Number.isFinite) ? (numbers as [number, number, number]) : undefined;
}

function entry(entries: Entries, keyword: string): Line & { words: readonly string[] } {
  const found = entries.get(keyword);
  if (found === undefined) throw new FormatProblem(`its PCD header has no line ${keyword}`);
  return found;
}

/** The points of a compressed file, field by field: all x, all y, all z. */
export function unpackPcd(body: Uint8Array, { name, count, fields }: Group): Uint8Array<ArrayBuffer> {
  const size = rowBytes(fields) * count;
  if (body.length < 8) throw endsEarly(0, count, name);
  const sizes = new DataView(body.buffer, body.byteOffset, 8);
  const [packed, unpacked] = [sizes.getUint32(0, true), sizes.getUint32(4, true)];
  if (unpacked !== size) {
    throw new FormatProblem(`its compressed data is ${unpacked} bytes long, and its header promises ${size}`);
  }
  if (packed > body.length - 8) throw endsEarly(0, count, name);
  const says = restSays(body.subarray(8 + packed), name);
  if (says !== undefined) throw new FormatProblem(says);
  return unpackLzf(body.subarray(8, 8 + packed), unpacked);
}
