import type { LoadedCloud } from "../cloud/cloud.ts";
import { bytes, type Reading } from "./blocks.ts";
import { bytesOf, numberReader, type NumberType } from "./numbers.ts";
import { LoadProblem } from "./problem.ts";
import { endsEarly, type Field, readBinaryRows, readTextRows } from "./rows.ts";

const TYPES: Record<string, NumberType> = {
  char: "int8", int8: "int8", uchar: "uint8", uint8: "uint8",
  short: "int16", int16: "int16", ushort: "uint16", uint16: "uint16",
  int: "int32", int32: "int32", uint: "uint32", uint32: "uint32",
  float: "float32", float32: "float32", double: "float64", float64: "float64",
}; // prettier-ignore

/** What is called otherwise in some files. */
const NAMES: Record<string, string> = {
  px: "x", posx: "x", py: "y", posy: "y", pz: "z", posz: "z",
  r: "red", diffuse_red: "red", g: "green", diffuse_green: "green", b: "blue", diffuse_blue: "blue",
}; // prettier-ignore

const LONGEST_HEADER = 1 << 20;

interface Property {
  name: string;
  type: NumberType;
  /** The type of the number that says how long the list is, or null for a single number. */
  list: NumberType | null;
}

export interface PlyElement {
  name: string;
  count: number;
  properties: Property[];
}

/** The vertices of a PLY file, whatever faces it has. */
export async function readPly(reading: Reading): Promise<LoadedCloud> {
  const { name } = reading;
  const { format, elements, end } = await readPlyHeader(reading);
  const at = elements.findIndex((element) => element.name === "vertex");
  if (at < 0) throw new LoadProblem(`${name} is a PLY file without vertices.`);
  const before = elements.slice(0, at);
  const { count, properties } = elements[at]!;
  if (properties.some(({ list }) => list)) {
    throw new LoadProblem(`${name} is a PLY file whose vertices have lists, which this page cannot read.`);
  }

  const { position, others, rowBytes } = fieldsOf(name, count, properties);
  const littleEndian = format === "binary_little_endian";
  let cloud: LoadedCloud;
  if (format === "ascii") {
    const skip = before.reduce((sum, element) => sum + element.count, 0);
    cloud = await readTextRows(reading, { start: end, count, position, others, skip });
  } else {
    const start = await passOver(reading, end, before, littleEndian, count);
    cloud = await readBinaryRows(reading, { start, count, position, others }, rowBytes, littleEndian);
  }
  const faces = elements.some((element) => element.name === "face" && element.count > 0);
  return { ...cloud, isMesh: faces && cloud.positions.length === 3 * count };
}

export interface PlyHeader {
  format: "ascii" | "binary_little_endian" | "binary_big_endian";
  elements: PlyElement[];
  /** Where what it describes begins. */
  end: number;
}

export async function readPlyHeader({ name, blob }: Reading): Promise<PlyHeader> {
  const { headerLines, end } = headerOf(name, await bytes(name, blob, 0, LONGEST_HEADER));
  const format = headerLines.find((line) => line.startsWith("format "))?.split(/\s+/)[1];
  if (format !== "ascii" && format !== "binary_little_endian" && format !== "binary_big_endian") {
    throw new LoadProblem(`${name} is a PLY file of an unknown format (${format ?? "none given"}).`);
  }
  return { format, elements: elementsOf(name, headerLines), end };
}

function headerOf(name: string, start: ArrayBuffer): { headerLines: string[]; end: number } {
  // Latin-1 keeps one character a byte, so that a position in the text is a position in the file.
  const match = /^ply[\s\S]*?[\r\n]end_header[ \t]*(\r\n|\r|\n|$)/.exec(new TextDecoder("latin1").decode(start));
  if (!match) throw new LoadProblem(`${name} is broken: its PLY header has no end.`);
  return { headerLines: match[0].split(/\r\n|\r|\n/).map((line) => line.trim()), end: match[0].length };
}

function elementsOf(name: string, headerLines: readonly string[]): PlyElement[] {
  const elements: PlyElement[] = [];
  const typeOf = (word: string | undefined): NumberType => {
    const type = TYPES[word ?? ""];
    if (!type)
      throw new LoadProblem(`${name} is broken: its PLY header has a property of unknown type (${word ?? "none"}).`);
    return type;
  };
  for (const line of headerLines) {
    const words = line.split(/\s+/);
    if (words[0] === "element") {
      const count = Number(words[2]);
      if (!Number.isSafeInteger(count) || count < 0) {
        throw new LoadProblem(`${name} is broken: its PLY header does not say how many points there are.`);
      }
      elements.push({ name: words[1] ?? "", count, properties: [] });
    } else if (words[0] === "property" && elements.length > 0) {
      const isList = words[1] === "list";
      const property = {
        name: words[isList ? 4 : 2] ?? "",
        type: typeOf(words[isList ? 3 : 1]),
        list: isList ? typeOf(words[2]) : null,
      };
      elements[elements.length - 1]!.properties.push(property);
    }
  }
  return elements;
}

function fieldsOf(name: string, count: number, properties: readonly Property[]) {
  let rowBytes = 0;
  const fields = properties.map((property, word): Field => {
    const offset = rowBytes;
    rowBytes += bytesOf(property.type);
    const lower = property.name.toLowerCase();
    const called =
      NAMES[lower] ?? (/^(x|y|z|red|green|blue)$/.test(lower) ? lower : property.name.replace(/^scalar_/, ""));
    return { name: called, type: property.type, offset, word };
  });
  const position = ["x", "y", "z"].map((axis) => fields.find((field) => field.name === axis));
  if (position.includes(undefined)) {
    throw new LoadProblem(
      count === 0 ? `${name} holds no points.` : `${name} is a PLY file whose vertices have no x, y and z.`,
    );
  }
  const others = fields.filter((field) => !position.includes(field));
  return { position: position as [Field, Field, Field], others, rowBytes };
}

/** Where an element of a binary file begins, behind others whose lists may have any length. */
export async function passOver(
  { name, blob }: Reading,
  start: number,
  before: readonly PlyElement[],
  littleEndian: boolean,
  promised: number,
): Promise<number> {
  if (before.length === 0) return start;
  const view = new DataView(await bytes(name, blob, start, blob.size));
  let at = 0;
  for (const { count, properties } of before) {
    for (let row = 0; row < count; row++) {
      for (const { type, list } of properties) {
        if (at + (list ? bytesOf(list) : 0) > view.byteLength) throw endsEarly(name, promised);
        const length = list ? numberReader(list, 0, littleEndian)(view, at) : 1;
        at += (list ? bytesOf(list) : 0) + Math.max(0, length) * bytesOf(type);
      }
    }
  }
  return start + at;
}
