// A second reader, written only from the definitions of the formats. It is slow, and it does not describe faults. It
// shares no code with the readers that it checks. It throws if it cannot read a file. It returns undefined if it has
// no opinion.

export function naive(name: string, content: Uint8Array): number[] | undefined {
  if (name.endsWith(".e57")) return undefined;
  // Of points3D.txt, only whether the command and the page read the same is compared.
  if (name.endsWith(".txt")) return undefined;
  if (name.endsWith(".npy")) return npy(content);
  if (name.endsWith(".bin")) return name === "points3D.bin" ? colmap(content) : floats(content, name);
  if (name.endsWith(".ply")) return ply(content);
  if (name.endsWith(".ptx")) return ptx(latin(content));
  return name.endsWith(".pcd") ? pcd(content) : table(new TextDecoder().decode(content));
}

const viewOf = (content: Uint8Array) => new DataView(content.buffer, content.byteOffset, content.byteLength);

/** An array, if its header is written as NumPy writes it. */
function npy(content: Uint8Array): number[] | undefined {
  const length = viewOf(content).getUint16(8, true);
  const head = latin(content.subarray(0, 10 + length));
  const said =
    /^\x93NUMPY\x01\x00..\{'descr': (.*), 'fortran_order': (True|False), 'shape': \((\d+), ?(\d*)\), \}\n$/s.exec(head);
  if (said === null) return undefined;
  const [, types = "", order, ...sizes] = said;
  const [count, width] = [Number(sizes[0]), sizes[1] === "" ? 1 : Number(sizes[1])];
  const all = [...types.matchAll(/\('(\w+)', '([<>])([fiu]\d)'\)/g)];
  const one = /^'([<>])([fiu]\d)'$/.exec(types);
  if (one === null && `[${all.map(([text]) => text).join(", ")}]` !== types) return undefined;
  const fields = one
    ? Array.from({ length: width }, (_, i) => ["xyz"[i] ?? "", ...one.slice(1)])
    : all.map((field) => field.slice(1));
  const sizeOf = (field: string[]) => Number(field[2]![1]);
  const row = fields.reduce((sum, field) => sum + sizeOf(field), 0);
  const start = 10 + length;
  if (start + count * row > content.length) fail();
  return Array.from({ length: 3 * count }, (_, k) => {
    const column = fields.findIndex(([name]) => name === "xyz"[k % 3]);
    const before = fields.slice(0, column).reduce((sum, field) => sum + sizeOf(field), 0);
    const i = Math.floor(k / 3);
    const [, bytes, type] = fields[column] ?? fail();
    const at = order === "True" ? (column * count + i) * sizeOf(fields[column]!) : i * row + before;
    return number(viewOf(content), start + at, type!, bytes === "<");
  });
}

/** A scan of floats. */
function floats(content: Uint8Array, name: string): number[] {
  const width = [name.endsWith(".pcd.bin") ? 5 : 4, 5].find((each) => content.length % (4 * each) === 0) ?? fail();
  const values = Array.from({ length: content.length / 4 }, (_, i) => number(viewOf(content), 4 * i, "f4", true));
  return values.filter((_, i) => i % width < 3);
}

/** Points of COLMAP, each with a track. */
function colmap(content: Uint8Array): number[] {
  const found: number[] = [];
  let [left, at] = [number(viewOf(content), 0, "u8", true), 8];
  for (; left > 0; left--) {
    found.push(...[8, 16, 24].map((place) => number(viewOf(content), at + place, "f8", true)));
    at += 51 + 8 * number(viewOf(content), at + 43, "u8", true);
  }
  // Zeros and blanks may follow.
  return at <= content.length && /^[\0\t-\r ]*$/.test(latin(content.subarray(at))) ? found : fail();
}

/** Scans that are not turned. */
function ptx(text: string): number[] | undefined {
  const lines = text.split(/\r\n|\r|\n/).filter((line) => !blank(line)).map((line) => strip(line).split(/[ \t\v\f]+/)); // prettier-ignore
  const found: number[] = [];
  while (lines.length > 0) {
    const [columns, rows, , , , , ...matrix] = lines.splice(0, 10);
    const turn = matrix.slice(0, 3).flat().map(real).join();
    if (turn !== "1,0,0,0,0,1,0,0,0,0,1,0") return undefined;
    const move = (matrix[3] ?? fail()).map(real);
    for (let left = whole(columns?.[0]) * whole(rows?.[0]); left > 0; left--) {
      const place = [0, 1, 2].map((axis) => real(lines[0]?.[axis]));
      // A place that is not three numbers cannot be turned.
      const isNone = place.every((x) => x === 0) || place.some((x) => Number.isNaN(x));
      found.push(...place.map((x, axis) => (isNone ? NaN : x + move[axis]!)));
      lines.shift();
    }
  }
  return found;
}

interface Column {
  name: string;
  type: string;
  size: number;
  count: number;
  list: { type: string; size: number } | undefined;
}

const latin = (content: Uint8Array) => Buffer.from(content).toString("latin1");
const blank = (text: string) => /^[ \t\v\f\r\n]*$/.test(text);
const strip = (text: string) => text.replace(/^[ \t\v\f\r\n]+/, "").replace(/[ \t\v\f\r\n]+$/, "");

function fail(): never {
  throw new Error("cannot be read");
}

function real(word: string | undefined): number {
  if (word === undefined) fail();
  if (/^[+-]?[0-9]+\.?[0-9]*([eE][+-]?[0-9]+)?$/.test(word)) return finite(parseFloat(word));
  if (/^[+-]?\.[0-9]+([eE][+-]?[0-9]+)?$/.test(word)) return finite(parseFloat(word));
  if (/^[+-]?(nan|inf|infinity|nan\(\w*\)|1\.#(inf|ind|qnan|snan)0*)$/i.test(word)) return NaN;
  fail();
}

const finite = (value: number) => (Number.isFinite(value) ? value : NaN);

function whole(word: string | undefined): number {
  if (word === undefined || !/^[0-9]+$/.test(word)) fail();
  return parseInt(word, 10);
}

/** The lines of the header, and where the data begins. All lines of a header end like its first line. */
function header(content: Uint8Array, isLast: (line: string) => boolean): { lines: string[]; start: number } {
  const text = latin(content).replace(/^\xef\xbb\xbf/, "");
  const mark = content.length - text.length;
  const end = /\r(?!\n)|\n/.exec(text)?.[0] ?? "\n";
  const lines: string[] = [];
  for (let at = 0; at < text.length;) {
    const next = text.indexOf(end, at) < 0 ? text.length : text.indexOf(end, at) + 1;
    const line = strip(text.slice(at, next));
    lines.push(line);
    at = next;
    if (isLast(line)) return { lines, start: at + mark };
  }
  fail();
}

const PLY_TYPES: Record<string, string> = {
  char: "i1", int8: "i1", uchar: "u1", uint8: "u1", short: "i2", int16: "i2", ushort: "u2", uint16: "u2",
  int: "i4", int32: "i4", uint: "u4", uint32: "u4", float: "f4", float32: "f4", double: "f8", float64: "f8",
}; // prettier-ignore

function ply(content: Uint8Array): number[] {
  const { lines, start } = header(content, (line) => line === "end_header");
  if (lines[0] !== "ply") fail();
  let format = "";
  const elements: { name: string; count: number; columns: Column[] }[] = [];
  for (const line of lines) {
    const words = line.split(/[ \t\v\f]+/);
    if (words[0] === "format") format = words[1]!;
    if (words[0] === "element") elements.push({ name: words[1]!, count: whole(words[2]), columns: [] });
    if (words[0] !== "property") continue;
    const type = (word: string | undefined) => PLY_TYPES[word ?? ""] ?? fail();
    const isList = words[1] === "list";
    const [kind, length] = isList ? [type(words[3]), type(words[2])] : [type(words[1]), undefined];
    elements.at(-1)!.columns.push({
      name: words.at(-1)!,
      type: kind,
      size: Number(kind[1]),
      count: 1,
      list: length === undefined ? undefined : { type: length, size: Number(length[1]) },
    });
  }
  const found: number[] = [];
  const texts = latin(content.subarray(start)).split(/\r\n|\r|\n/).filter((line) => !blank(line)); // prettier-ignore
  const view = new DataView(content.buffer, content.byteOffset, content.byteLength);
  let at = start;
  for (const { name, count, columns } of elements) {
    const axes = name === "vertex" ? axesIn(columns) : [];
    for (let row = 0; row < count && columns.length > 0; row++) {
      const values = new Map<Column, number>();
      if (format === "ascii") {
        const words = strip(texts.shift() ?? fail()).split(/[ \t\v\f]+/);
        for (const column of columns) {
          const word = words.shift();
          if (axes.includes(column)) values.set(column, typed(real(word), column.type));
          else if (word === undefined) fail();
          if (column.list) words.splice(0, whole(word));
        }
        if (words.length > 0) fail();
      } else {
        const little = format === "binary_little_endian";
        for (const column of columns) {
          const length = column.list ? number(view, at, column.list.type, little) : 1;
          if (column.list) at += column.list.size;
          if (length < 0 || at + length * column.size > content.length) fail();
          if (!column.list) values.set(column, number(view, at, column.type, little));
          at += length * column.size;
        }
      }
      for (const axis of axes) found.push(values.get(axis)!);
    }
  }
  if (format === "ascii" ? texts.length > 0 : !/^[\0\t-\r ]*$/.test(latin(content.subarray(at)))) fail();
  return found;
}

function axesIn(columns: readonly Column[]): Column[] {
  for (const before of ["", "p", "pos"]) {
    const axes = ["x", "y", "z"].map((axis) => columns.filter(({ name }) => name.toLowerCase() === before + axis));
    if (axes.every(({ length }) => length === 1)) return axes.flat();
    if (axes.every(({ length }) => length > 0)) fail();
  }
  fail();
}

/** A number from a text: all its digits count, whatever its type. An integer type must be given an integer. */
function typed(value: number, type: string): number {
  if (!type.startsWith("f") && !Number.isInteger(value)) fail();
  return value;
}

function number(view: DataView, at: number, type: string, little: boolean): number {
  if (at + Number(type[1]) > view.byteLength) fail();
  switch (type) {
    case "i1": return view.getInt8(at);
    case "u1": return view.getUint8(at);
    case "i2": return view.getInt16(at, little);
    case "u2": return view.getUint16(at, little);
    case "i4": return view.getInt32(at, little);
    case "u4": return view.getUint32(at, little);
    case "i8": return Number(view.getBigInt64(at, little));
    case "u8": return Number(view.getBigUint64(at, little));
    case "f4": return view.getFloat32(at, little);
    default: return view.getFloat64(at, little);
  } // prettier-ignore
}

function pcd(content: Uint8Array): number[] {
  const { lines, start } = header(content, (line) => /^data\b/i.test(line));
  const said = new Map(
    lines.map((line) => line.split(/[ \t\v\f]+/)).map(([word, ...rest]) => [word!.toUpperCase(), rest]),
  );
  const names = said.get("FIELDS") ?? said.get("COLUMNS") ?? fail();
  const columns = names.map((name, i): Column => {
    const [size, count] = [whole(said.get("SIZE")?.[i]), said.has("COUNT") ? whole(said.get("COUNT")![i]) : 1];
    return { name, type: `${said.get("TYPE")![i]!.toLowerCase()}${size}`, size, count, list: undefined };
  });
  const image = said.has("WIDTH") ? whole(said.get("WIDTH")![0]) * whole(said.get("HEIGHT")?.[0] ?? "1") : undefined;
  const count = said.has("POINTS") ? whole(said.get("POINTS")![0]) : (image ?? fail());
  if (image !== undefined && image !== count) fail();
  const axes = axesIn(columns);
  const offset = (column: Column, of: (each: Column) => number) =>
    columns.slice(0, columns.indexOf(column)).reduce((sum, each) => sum + of(each), 0);
  const kind = said.get("DATA")![0]!.toLowerCase();
  const found: number[] = [];
  if (kind === "ascii") {
    const rows = latin(content.subarray(start)).split(/\r\n|\r|\n/).filter((line) => !blank(line)); // prettier-ignore
    const width = columns.reduce((sum, each) => sum + each.count, 0);
    for (const row of rows) {
      const words = strip(row).split(/[ \t\v\f]+/);
      if (words.length !== width) fail();
      for (const axis of axes) found.push(typed(real(words[offset(axis, (each) => each.count)]), axis.type));
    }
    if (rows.length !== count) fail();
    return found;
  }
  const size = columns.reduce((sum, each) => sum + each.size * each.count, 0);
  const data = kind === "binary" ? content.subarray(start) : unpacked(content.subarray(start));
  if (data.length < size * count) fail();
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  for (let i = 0; i < count; i++) {
    for (const axis of axes) {
      const before = offset(axis, (each) => each.size * each.count);
      const place = kind === "binary" ? i * size + before : before * count + i * axis.size;
      found.push(number(view, place, axis.type, true));
    }
  }
  return found;
}

function unpacked(data: Uint8Array): Uint8Array {
  const length = new DataView(data.buffer, data.byteOffset, data.byteLength).getUint32(0, true);
  const packed = [...data.subarray(8, 8 + length)];
  const out: number[] = [];
  while (packed.length > 0) {
    const control = packed.shift()!;
    if (control < 32) {
      out.push(...packed.splice(0, control + 1));
      continue;
    }
    const run = (control >> 5 === 7 ? 7 + packed.shift()! : control >> 5) + 2;
    const back = (control % 32) * 256 + packed.shift()! + 1;
    for (let i = 0; i < run; i++) out.push(out[out.length - back] ?? fail());
  }
  return Uint8Array.from(out);
}

/** The names of x, y and z, the best first: the exact ones, words, the letters of surveyors, and all of them mixed. */
const AXES = [
  [/^x$/, /^y$/, /^z$/],
  [/^(x|easting|east)$/, /^(y|northing|north)$/, /^(z|height)$/],
  [/^e$/, /^n$/, /^h$/],
  [/^(x|easting|east|e)$/, /^(y|northing|north|n)$/, /^(z|height|h)$/],
];
const UNITS = ["m", "mm", "cm", "dm", "km", "um", "ft", "in", "yd"];

interface Head {
  names: string[];
  /** The columns of x, y and z. */
  places: number[];
  /** Tabs divide the names, so a name may hold spaces. */
  tabs: boolean;
}

/**
 * Reads tables without quotation marks, as docs/COMMAND.md describes them. It knows only the names of columns and the
 * units that the fuzzer writes, and their changes.
 */
function table(text: string): number[] | undefined {
  if (text.includes('"')) return undefined;
  const lines = text.split(/\r\n|\r|\n/).filter((line) => !blank(line)); // prettier-ignore
  const isComment = (line: string) => /^(#|\/\/)/.test(strip(line));
  const body = lines.filter((line) => !isComment(line));
  const promised = /^[0-9]+$/.test(strip(body[0] ?? "")) ? whole(strip(body.shift()!)) : undefined;
  const head = isPoint(body[0] ?? fail()) ? undefined : headOf(strip(body.shift()!));
  if (head !== undefined && !isPoint(body[0] ?? fail(), head)) requireUnits(body.shift()!, head);

  const first = body[0] ?? fail();
  const by = dividerBelow(first, head);
  const width = head?.names.length ?? wordsIn(first, by).length;
  const comments = lines.slice(0, lines.indexOf(first)).filter(isComment);
  const rows = body.slice(0, 200).map((line) => wordsIn(line, by, width));
  const places = head?.places ?? commentedPlaces(comments, width, /[;,]/.test(by.source)) ?? unnamedPlaces(rows);
  const found: number[] = [];
  for (const line of body) {
    const words = wordsIn(line, by, width);
    if (words.length !== width) fail();
    for (const place of places) found.push(cellIn(words[place]));
  }
  if (promised !== undefined && promised !== found.length / 3) fail();
  return found;
}

/** Without names, a point has three numbers. Below names, it has one word for each name, and x, y and z are numbers. */
function isPoint(line: string, head?: Head): boolean {
  const words = wordsIn(line, dividerBelow(line, head), head?.names.length);
  if (head === undefined) return words.filter((word) => word !== "" && isCell(word)).length >= 3;
  return words.length === head.names.length && head.places.every((place) => isCell(words[place]!));
}

/** Below the names, one line may give the unit of x, y and z. It has one word for each name. */
function requireUnits(line: string, head: Head): void {
  const words = wordsIn(line, dividerBelow(line, head), head.names.length);
  const given = new Set(head.places.map((place) => words[place]!.toLowerCase()).filter((unit) => unit !== ""));
  if (words.length !== head.names.length || given.size !== 1 || !UNITS.includes([...given][0]!)) fail();
}

function headOf(line: string): Head {
  const by = dividerOf(line);
  const tabs = !/[;,]/.test(by.source) && line.includes("\t");
  const names = namesOf(line, tabs ? /\t/ : by);
  return { names, places: placesIn(names) ?? fail(), tabs };
}

function dividerBelow(line: string, head: Head | undefined): RegExp {
  return head?.tabs === true && strip(line).includes("\t") ? /\t/ : dividerOf(strip(line));
}

/** The words of a line. At the end of a line of this width, one more divider may stand. */
function wordsIn(line: string, by: RegExp, width?: number): string[] {
  const words = (by.source === "\\t" ? line : strip(line)).split(by).map(strip);
  if (width !== undefined && words.length === width + 1 && words.at(-1) === "") words.pop();
  return words;
}

function namesOf(line: string, by: RegExp): string[] {
  return line.split(by).map((name) =>
    name
      .trim()
      .toLowerCase()
      .replace(/[ _.-]m$/, ""),
  );
}

/** The columns of x, y and z, if there are names for all three. */
function placesIn(names: readonly string[]): number[] | undefined {
  const found = AXES.map((axes) => axes.map((axis) => names.flatMap((name, i) => (axis.test(name) ? [i] : [])))).find(
    (places) => places.every(({ length }) => length > 0),
  );
  return found?.every(({ length }) => length === 1) === false ? fail() : found?.flat();
}

/** The columns of x, y and z that a comment names. */
function commentedPlaces(comments: readonly string[], width: number, marked: boolean): number[] | undefined {
  for (const comment of comments.toReversed()) {
    const line = strip(comment).replace(/^(#+|\/\/+)\s*/, "");
    const by = dividerOf(line);
    const tabs = !marked && !/[;,]/.test(by.source) && line.includes("\t");
    const names = namesOf(line, tabs ? /\t/ : by);
    const places = names.length === width ? placesIn(names) : undefined;
    if (places !== undefined) return places;
  }
  return undefined;
}

/** The first three columns, or those after a column of consecutive integers. */
function unnamedPlaces(rows: readonly string[][]): number[] {
  const isColumn = (place: number, holds: (word: string, row: number) => boolean) =>
    rows.every((words, row) => words[place] !== undefined && holds(words[place], row));
  const count = (word: string, row: number) => /^[0-9]+$/.test(word) && Number(word) === Number(rows[0]![0]) + row;
  const byte = (word: string) => /^[0-9]{1,3}$/.test(word) && Number(word) < 256;
  const numbered = isColumn(0, count) && [1, 2, 3].every((place) => isColumn(place, isCell)) && rows.length > 2;
  const isGrid = isColumn(1, (word) => word === rows[0]![1]);
  const isColored = rows[0]!.length === 6 && [3, 4, 5].every((place) => isColumn(place, byte));
  return numbered && !isGrid && !isColored ? [1, 2, 3] : [0, 1, 2];
}

function dividerOf(line: string): RegExp {
  if (line.includes(";")) return /;/;
  const spaced = line.split(/[ \t\v\f]+/);
  const decimal = !/,([ \t\v\f]|$)/.test(line) && spaced.filter(isCell).length >= 3;
  return line.includes(",") && !decimal ? /,/ : /[ \t\v\f]+/;
}

function isCell(word: string): boolean {
  try {
    cellIn(word);
    return true;
  } catch {
    return false;
  }
}

function cellIn(word: string | undefined): number {
  if (word !== undefined && /^(|na|n\/a|#n\/a|null|none)$/i.test(word)) return NaN;
  if (word !== undefined && /^[+-]?[0-9]*,[0-9]+([eE][+-]?[0-9]+)?$/.test(word)) return real(word.replace(",", "."));
  return real(word);
}
