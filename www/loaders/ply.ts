import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import type { LoadedCloud } from "../cloud.ts";
import { pointsOf } from "./geometry.ts";
import { checkPointCount } from "./limits.ts";
import { LoadProblem } from "./problem.ts";

const BYTES: Record<string, number> = {
  char: 1, uchar: 1, int8: 1, uint8: 1,
  short: 2, ushort: 2, int16: 2, uint16: 2,
  int: 4, uint: 4, int32: 4, uint32: 4, float: 4, float32: 4,
  double: 8, float64: 8,
}; // prettier-ignore

interface PlyElement {
  name: string;
  count: number;
  /** The header's own lines, and the bytes one takes in a binary file (NaN with a list, whose length varies). */
  lines: string[];
  bytes: number;
}

/**
 * PLYLoader, with a look at the header first. It reads what is missing as nothing and takes a mesh apart by its faces, so
 * the header it gets to see ends with the vertices, and the number it finds must be the number promised.
 */
export function readPly(name: string, data: ArrayBuffer): LoadedCloud {
  const { text, end } = headerText(name, data);
  const lines = text.split(/\r\n|\r|\n/).map((line) => line.trim());
  const format = lines.find((line) => line.startsWith("format "))?.split(/\s+/)[1];
  if (format !== "ascii" && format !== "binary_little_endian" && format !== "binary_big_endian") {
    throw new LoadProblem(`${name} is a PLY file of an unknown format (${format ?? "none given"}).`);
  }

  const elements = readElements(name, lines);
  const at = elements.findIndex((element) => element.name === "vertex");
  if (at < 0) throw new LoadProblem(`${name} is a PLY file without vertices.`);
  if (format === "ascii" && /\d,\d/.test(new TextDecoder().decode(new Uint8Array(data, end, Math.min(4096, data.byteLength - end))))) {
    throw new LoadProblem(`${name} is broken: its numbers have commas, which a PLY file writes as points.`);
  }
  const wanted = elements.slice(0, at + 1);
  const vertex = elements[at]!;
  checkPointCount(name, vertex.count);

  const body = data.byteLength - end;
  const needed = wanted.reduce((sum, element) => sum + element.count * element.bytes, 0);
  if (format !== "ascii" && needed > body) throw endsEarly(name, vertex.count);

  const header = ["ply", `format ${format} 1.0`, ...wanted.flatMap((element) => element.lines), "end_header", ""].join("\n");
  const loader = new PLYLoader();
  const geometry =
    format === "ascii"
      ? loader.parse(header + new TextDecoder().decode(new Uint8Array(data, end)))
      : loader.parse(joined(new TextEncoder().encode(header), new Uint8Array(data, end)));

  // An ASCII float is a float: the type the header declares decides, as it does in a binary file.
  const double = !vertex.lines.some((line) => /^property\s+float(32)?\s+(x|px|posx)$/.test(line));
  const cloud = pointsOf(geometry, double ? "double" : "single");
  if (cloud.positions.length === 0 && vertex.count > 0) {
    throw new LoadProblem(`${name} is a PLY file whose vertices have no x, y and z.`);
  }
  if (cloud.positions.length !== 3 * vertex.count) throw endsEarly(name, vertex.count);
  return cloud;
}

function headerText(name: string, data: ArrayBuffer): { text: string; end: number } {
  // Latin-1 keeps one character a byte, so that a position in the text is a position in the file.
  const start = new TextDecoder("latin1").decode(new Uint8Array(data, 0, Math.min(data.byteLength, 1 << 20)));
  const match = /^ply[\s\S]*?[\r\n]end_header[ \t]*(\r\n|\r|\n|$)/.exec(start);
  if (!match) throw new LoadProblem(`${name} is broken: its PLY header has no end.`);
  return { text: match[0], end: match[0].length };
}

function readElements(name: string, lines: string[]): PlyElement[] {
  const elements: PlyElement[] = [];
  for (const line of lines) {
    const words = line.split(/\s+/);
    if (words[0] === "element") {
      const count = Number(words[2]);
      if (!Number.isInteger(count) || count < 0) {
        throw new LoadProblem(`${name} is broken: its PLY header does not say how many points there are.`);
      }
      elements.push({ name: words[1] ?? "", count, lines: [line], bytes: 0 });
    } else if (words[0] === "property" && elements.length > 0) {
      const element = elements[elements.length - 1]!;
      // Some programs write X, Y and Z; the loader knows x, y and z.
      element.lines.push(words[1] === "list" ? line : line.toLowerCase());
      if (words[1] !== "list" && BYTES[words[1] ?? ""] === undefined) {
        throw new LoadProblem(`${name} is broken: its PLY header has a property of unknown type (${words[1] ?? "none"}).`);
      }
      element.bytes += BYTES[words[1] ?? ""] ?? NaN;
    }
  }
  return elements;
}

function endsEarly(name: string, promised: number): LoadProblem {
  return new LoadProblem(`${name} is broken: it ends before the ${promised.toLocaleString("en-US")} points its header promises.`);
}

function joined(head: Uint8Array, body: Uint8Array): ArrayBuffer {
  const all = new Uint8Array(head.length + body.length);
  all.set(head);
  all.set(body, head.length);
  return all.buffer;
}
