import { axesOf, type ChosenColumns } from "./axes.js";
import { countIn, type NumberType, type FilledColumn, PACKED, bytesOf } from "./numbers.js";
import { endsEarly, FormatProblem, lineProblem, Contradictions } from "./problem.js";
import { type Axes, type Field, type Group, rowBytes, fieldsSaid, listsIn } from "./rows.js";
import { headerLines, type Line, restSays, wordsOf } from "./text.js";
import type { CloudFile, Place, Reading } from "./cloud-file.js";
import { checkEnd, endOfRows, otherColumns, readBinaryRows, readTextRows } from "./read-rows.js";
import { bytesSource, checkByteLength, isTooMuch, viewOf } from "./source.js";

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

/** The rows of a compressed file. It has all values of a field before all values of the next one: all x, all y, all z. */
function unpackedRows(body: Uint8Array, group: Group, found: Contradictions): Uint8Array<ArrayBuffer> {
  const { name, count, fields } = group;
  const size = rowBytes(fields) * count;
  const header = viewOf(body);
  const [packed, length] = body.length < 8 ? [8, size] : [header.getUint32(0, true), header.getUint32(4, true)];
  if (length !== size) {
    throw new FormatProblem(`its compressed data is ${length} bytes long, and its header promises ${size}`);
  }
  const columns = unpackLzf(body.subarray(8, 8 + packed), length);
  const last = fields.reduce((_, { count: each, type }) => each * bytesOf(type), 0);
  // A point is whole if it has its last field.
  const whole = Math.max(0, Math.floor((columns.length - size) / last) + count);
  const isCut = packed > body.length - 8;
  if (isCut) found.add(endsEarly(whole, count, name).message);
  else if (columns.length < size) found.add(`its compressed data is damaged after ${whole} of ${count} points`);
  const says = restSays(body.subarray(8 + packed), name);
  if (says !== undefined) found.add(says);
  return interleaved(columns, group, whole);
}

/**
 * Unpacks LZF, the compression of PCD files, up to the end or to the first fault. It has runs of plain bytes, and copies
 * from up to 8 kB back.
 */
function unpackLzf(packed: Uint8Array, length: number): Uint8Array<ArrayBuffer> {
  const unpacked = new Uint8Array(length);
  // A fault behind the last byte is a fault, too.
  const before = (to: number) => unpacked.subarray(0, Math.max(0, Math.min(to, length - 1)));
  let [from, to] = [0, 0];
  while (from < packed.length) {
    const control = packed[from++]!;
    if (control < 32) {
      const run = packed.subarray(from, from + Math.min(control + 1, length - to));
      unpacked.set(run, to);
      from += run.length;
      to += run.length;
      if (run.length <= control) return before(to);
      continue;
    }
    let count = (control >> 5) + 2;
    if (count === 9) count += packed[from++] ?? NaN;
    const back = ((control & 31) << 8) + (packed[from++] ?? NaN) + 1;
    if (!(back <= to && to + count <= length)) return before(to);
    // Bytes are copied one by one, because a copy may repeat bytes that it has just written.
    for (let i = 0; i < count; i++, to++) unpacked[to] = unpacked[to - back]!;
  }
  return unpacked.subarray(0, to);
}

/** PCD: text, binary and compressed. */
export async function readPcd(reading: Reading): Promise<CloudFile> {
  const header = readPcdHeader(await reading.source.read(0, LONGEST_PCD_HEADER), reading.chosen);
  const cloud = await readPoints(reading, header);
  return {
    ...withoutPacked(cloud),
    ...taken(header),
    unread: listsIn(header.points),
    axes: fieldsSaid(header.points.fields, header.axes),
  };
}

async function readPoints(reading: Reading, { data, points: group, axes, end, lines }: PcdHeader): Promise<CloudFile> {
  // A color has four bytes and may have the type float. Reading it as a float would change the bytes that are not a
  // number.
  const typeOf = (name: string, type: NumberType) =>
    PACKED.test(name) && data !== "ascii" && bytesOf(type) === 4 ? "uint32" : type;
  const points = { group, axes, others: otherColumns(group, axes, (name) => name, typeOf) };
  if (data === "ascii") return readTextRows(reading, { start: end, firstNumber: lines.length + 1 }, [group], points);
  if (data === "binary") {
    const cloud = await readBinaryRows(reading, end, points);
    const found = new Contradictions(reading.damaged);
    await checkEnd(reading.source, await endOfRows(reading, end, group, true, found), group.name, found);
    return { ...cloud, notes: [...new Set([...cloud.notes, ...found.notes])] };
  }
  const { size } = reading.source;
  checkByteLength(size);
  const bytes = rowBytes(group.fields) * group.count;
  checkByteLength(bytes);
  if (isTooMuch(bytes, size)) {
    throw new FormatProblem(`it promises ${bytes} bytes in ${size}; write it without compression`);
  }
  const found = new Contradictions(reading.damaged);
  const rows = unpackedRows(await reading.source.read(end, size), group, found);
  const count = rows.length / rowBytes(group.fields);
  const { records, ...cloud } = await readBinaryRows({ ...reading, source: bytesSource(rows) }, 0, {
    ...points,
    group: { ...group, count },
  });
  return { ...cloud, notes: [...cloud.notes, ...found.notes], records: { ...records, bytes: rows } };
}

/** The first rows of data that has all values of a field before all values of the next field. */
export function interleaved(columns: Uint8Array, { fields, count }: Group, rows: number): Uint8Array<ArrayBuffer> {
  const size = rowBytes(fields);
  const data = new Uint8Array(size * rows);
  let [from, offset] = [0, 0];
  for (const field of fields) {
    const width = field.count * bytesOf(field.type);
    for (let i = 0; i < rows; i++) {
      for (let byte = 0; byte < width; byte++) data[i * size + offset + byte] = columns[from + i * width + byte]!;
    }
    from += count * width;
    offset += width;
  }
  return data;
}

/** A color is four bytes in one number. A text may write them as the float with the same bytes. */
function withoutPacked(cloud: CloudFile): CloudFile {
  const found = cloud.columns.find(({ name }) => PACKED.test(name));
  if (!found) return cloud;
  return { ...cloud, columns: cloud.columns.filter((column) => column !== found), packed: unpackedColors(found) };
}

function unpackedColors({ values }: FilledColumn): Uint8Array<ArrayBuffer> {
  const bits = values instanceof Float32Array ? new Uint32Array(values.buffer) : values;
  const bytes = new Uint8Array(3 * bits.length);
  for (let i = 0; i < bits.length; i++) {
    bytes[3 * i] = (bits[i]! >>> 16) & 255;
    bytes[3 * i + 1] = (bits[i]! >>> 8) & 255;
    bytes[3 * i + 2] = bits[i]! & 255;
  }
  return bytes;
}

/**
 * The cloud of a depth camera, as rows and columns in the camera's coordinates: x to the right, y down, z ahead. Other
 * clouds have a station if their header tells of one: programs write 0 0 0 into all files.
 */
function taken({ height, viewpoint = [0, 0, 0] }: PcdHeader): Pick<CloudFile, "isGrid" | "up" | "stations"> {
  const stations = [{ name: "viewpoint", viewpoint: [...viewpoint] as Place }];
  if (height > 1) return { isGrid: true, up: "-y", stations };
  return viewpoint.some((value) => value !== 0) ? { stations } : {};
}
