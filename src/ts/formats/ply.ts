import { axesOf, type ChosenColumns } from "./axes.js";
import { countIn, isWhole, type NumberType } from "./numbers.js";
import { FormatProblem, lineProblem, Contradictions } from "./problem.js";
import { type Axes, type Field, type Group, fieldsSaid, listsIn } from "./rows.js";
import { headerLines, type Line, wordsOf } from "./text.js";
import type { CloudFile, Reading } from "./cloud-file.js";
import { splatColors } from "./colors.js";
import { checkEnd, endOfRows, otherColumns, type Points, readBinaryRows, readTextRows } from "./read-rows.js";

/** The largest size of a PLY header in bytes. */
export const LONGEST_PLY_HEADER = 1 << 20;

const SPACE = 0x20;

export interface PlyHeader {
  format: "ascii" | "binary_little_endian" | "binary_big_endian";
  elements: readonly Group[];
  vertices: Group;
  axes: Axes;
  /** The lines of the header. Lines about an element carry its name. */
  lines: readonly (Line & { element?: string })[];
  /** The end of the header, in bytes. */
  end: number;
}

const TYPES: Record<string, NumberType> = {
  char: "int8", int8: "int8", uchar: "uint8", uint8: "uint8",
  short: "int16", int16: "int16", ushort: "uint16", uint16: "uint16",
  int: "int32", int32: "int32", uint: "uint32", uint32: "uint32",
  float: "float32", float32: "float32", double: "float64", float64: "float64",
}; // prettier-ignore

interface Element extends Group {
  fields: Field[];
}

/** @param start the file's bytes, or the first LONGEST_PLY_HEADER of them */
export function readPlyHeader(start: Uint8Array, chosen?: ChosenColumns): PlyHeader {
  let format: PlyHeader["format"] | undefined;
  const elements: Element[] = [];
  const lines: (Line & { element?: string })[] = [];
  for (const line of headerLines(start.subarray(0, LONGEST_PLY_HEADER))) {
    const { text, number } = line;
    const [keyword = "", ...words] = wordsOf(text);
    if (number === 1) {
      // The text is trimmed, but no space may come before the word. A byte order mark may.
      if (text !== "ply" || start[0]! <= SPACE) throw new FormatProblem("it does not begin like a PLY file");
    } else if (keyword === "format") {
      if (format !== undefined) throw lineProblem(number, "gives the PLY format a second time", text);
      format = formatIn(words, line);
    } else if (keyword === "element") {
      elements.push(elementIn(words, line, elements));
    } else if (keyword === "property") {
      const element = elements.at(-1);
      if (element === undefined) throw lineProblem(number, "is a property of no element", text);
      element.fields.push(propertyIn(words, line, element));
    } else if (keyword !== "" && keyword !== "comment" && keyword !== "obj_info" && text !== "end_header") {
      throw lineProblem(number, "is not a line of a PLY header", text);
    }
    const element = keyword === "element" || keyword === "property" ? elements.at(-1)!.name : undefined;
    lines.push({ ...line, ...(element === undefined ? {} : { element }) });
    if (text !== "end_header") continue;
    if (format === undefined) throw new FormatProblem("its PLY header gives no format");
    return { format, elements, lines, end: line.end, ...pointsIn(elements, chosen) };
  }
  throw new FormatProblem("its PLY header has no end");
}

function formatIn([format, version, ...more]: string[], { text, number }: Line): PlyHeader["format"] {
  if (format !== "ascii" && format !== "binary_little_endian" && format !== "binary_big_endian") {
    throw lineProblem(
      number,
      "gives a PLY format that is none of ascii, binary_little_endian and binary_big_endian",
      text,
    );
  }
  if (version !== "1.0" || more.length > 0) throw lineProblem(number, "gives a PLY version that is not 1.0", text);
  return format;
}

function elementIn([name, written, ...more]: string[], { text, number }: Line, before: readonly Element[]): Element {
  const count = countIn(written);
  if (name === undefined || count === undefined || more.length > 0) {
    throw lineProblem(number, "does not give the number of an element", text);
  }
  if (before.some((element) => element.name === name)) {
    throw lineProblem(number, "names an element a second time", text);
  }
  return { name, count, fields: [] };
}

function propertyIn(words: string[], { text, number }: Line, { fields }: Element): Field {
  const isList = words[0] === "list";
  const [lengthName, typeName, name, ...more] = isList ? words.slice(1) : [undefined, ...words];
  const [type, length] = [typeIn(typeName), typeIn(lengthName)];
  if (type === undefined || (isList && length === undefined)) {
    throw lineProblem(number, "is a property of unknown type", text);
  }
  if (name === undefined || more.length > 0) throw lineProblem(number, "does not name one property", text);
  if (length !== undefined && !isWhole(length)) {
    throw lineProblem(number, "counts the values of a list in a type that is not an integer", text);
  }
  if (fields.some((field) => field.name === name)) throw lineProblem(number, "names a property a second time", text);
  return { name, type, count: 1, ...(length === undefined ? {} : { length }) };
}

function typeIn(name: string | undefined): NumberType | undefined {
  return name !== undefined && Object.hasOwn(TYPES, name) ? TYPES[name] : undefined;
}

function pointsIn(elements: readonly Element[], chosen?: ChosenColumns): Pick<PlyHeader, "vertices" | "axes"> {
  const vertices = elements.find(({ name }) => name === "vertex");
  if (vertices === undefined) throw new FormatProblem("it is a PLY file without vertices");
  const axes = axesOf(
    vertices.fields.map(({ name }) => name),
    chosen,
  );
  const list = axes.map((axis) => vertices.fields[axis]!).find(({ length }) => length !== undefined);
  if (list) throw new FormatProblem(`the ${list.name} of its vertices is a list`);
  return { vertices, axes };
}

const SPLATS = "it holds Gaussian splats: their centers are read as points, with their base colors";

/** The vertices of a PLY file. Its faces are ignored. */
export async function readPly(reading: Reading): Promise<CloudFile> {
  const header = readPlyHeader(await reading.source.read(0, LONGEST_PLY_HEADER), reading.chosen);
  const { elements, vertices, axes, end, lines } = header;
  const points = {
    group: vertices,
    axes,
    others: otherColumns(vertices, axes, (name) => name.replace(/^scalar_/, "")),
  };
  const cloud =
    header.format === "ascii"
      ? await readTextRows(reading, { start: end, firstNumber: lines.length + 1 }, elements, points)
      : await readBinary(reading, header, points);
  const packed = splatColors(cloud.columns);
  return {
    ...cloud,
    ...(packed && { packed, notes: [...cloud.notes, SPLATS] }),
    unread: listsIn(vertices),
    axes: fieldsSaid(vertices.fields, axes),
  };
}

async function readBinary(reading: Reading, header: PlyHeader, points: Points): Promise<CloudFile> {
  const { format, elements, vertices, end } = header;
  const littleEndian = format === "binary_little_endian";
  const found = new Contradictions(reading.damaged);
  let at = end;
  let cloud: CloudFile | undefined;
  for (const element of elements) {
    if (element === vertices) cloud = await readBinaryRows(reading, at, points, littleEndian);
    at = await endOfRows(reading, at, element, littleEndian, found);
  }
  await checkEnd(reading.source, at, elements.at(-1)!.name, found);
  return { ...cloud!, notes: [...new Set([...cloud!.notes, ...found.notes])] };
}
