import type { NumberType } from "./binary.js";
import { linesOf } from "./lines.js";
import { FileProblem } from "./point-file.js";

const TYPES: Record<string, NumberType> = {
  char: "Int8",
  int8: "Int8",
  uchar: "Uint8",
  uint8: "Uint8",
  short: "Int16",
  int16: "Int16",
  ushort: "Uint16",
  uint16: "Uint16",
  int: "Int32",
  int32: "Int32",
  uint: "Uint32",
  uint32: "Uint32",
  float: "Float32",
  float32: "Float32",
  double: "Float64",
  float64: "Float64",
};

export interface Property {
  name: string;
  type: NumberType;
  /** Of a list, the type of its length. */
  length?: NumberType;
}

export interface Element {
  name: string;
  count: number;
  properties: Property[];
}

export interface PlyHeader {
  format: "ascii" | "little" | "big";
  elements: Element[];
  /** Its lines with their ends; those about an element carry its name. */
  lines: { text: string; element?: string }[];
  /** Where the header ends, in bytes and lines. */
  end: number;
  lineCount: number;
}

const FORMATS: Record<string, PlyHeader["format"]> = {
  ascii: "ascii",
  binary_little_endian: "little",
  binary_big_endian: "big",
};

export function readPlyHeader(file: Buffer): PlyHeader {
  let format: PlyHeader["format"] | undefined;
  const elements: Element[] = [];
  const lines: PlyHeader["lines"] = [];
  for (const { text, number, start, end } of linesOf(file)) {
    const [keyword, ...words] = text.split(/\s+/);
    if (number === 1 && keyword !== "ply") throw new FileProblem("it does not begin as a PLY file does");
    if (keyword === "format") format = FORMATS[words[0] ?? ""];
    if (keyword === "element") elements.push(readElement(words, text));
    if (keyword === "property") elements.at(-1)?.properties.push(readProperty(words, text));
    const element = keyword === "element" || keyword === "property" ? elements.at(-1)?.name : undefined;
    lines.push({ text: file.toString("latin1", start, end), ...(element === undefined ? {} : { element }) });
    if (keyword === "end_header") {
      if (format === undefined)
        throw new FileProblem("its PLY format is none of ascii, binary_little_endian and binary_big_endian");
      return { format, elements, lines, end, lineCount: number };
    }
  }
  throw new FileProblem("its PLY header has no end");
}

function readElement([name = "", written = ""]: string[], line: string): Element {
  const count = Number(written);
  if (!/^\d+$/.test(written) || !Number.isSafeInteger(count))
    throw new FileProblem(`its PLY header does not say how many there are: "${line}"`);
  return { name, count, properties: [] };
}

function readProperty(words: string[], line: string): Property {
  const [lengthName, typeName, name] = words[0] === "list" ? words.slice(1) : [undefined, ...words];
  const [type, length] = [TYPES[typeName ?? ""], TYPES[lengthName ?? ""]];
  if (type === undefined || name === undefined || (lengthName !== undefined && length === undefined)) {
    throw new FileProblem(`its PLY header has a property of unknown type: "${line}"`);
  }
  return { name, type, ...(length === undefined ? {} : { length }) };
}
