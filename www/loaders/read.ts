import type { LoadedCloud } from "../cloud.ts";
import { readObj } from "./obj.ts";
import { readPcd } from "./pcd.ts";
import { readPly } from "./ply.ts";
import { LoadProblem } from "./problem.ts";
import { readXyz } from "./xyz.ts";

export const FORMATS = "PLY, PCD, XYZ, TXT, CSV and OBJ";

/** Reads a file by what it begins with, and by the ending of its name where its beginning says nothing. */
export function readFile(name: string, data: ArrayBuffer): LoadedCloud {
  const start = new TextDecoder("latin1").decode(new Uint8Array(data, 0, Math.min(data.byteLength, 4096)));
  const ending = /\.([a-z0-9]+)$/i.exec(name)?.[1]?.toLowerCase() ?? "";
  try {
    if (/^ply\s/.test(start)) return readPly(name, data);
    if (/^(#.*\.PCD|VERSION\s|FIELDS\s)/m.test(start) && ending !== "obj") return readPcd(name, data);
    if (ending === "ply" || ending === "pcd") {
      throw new LoadProblem(`${name} is not a point cloud: it does not begin like a ${ending.toUpperCase()} file.`);
    }
    const encoding = encodingOf(data);
    if (encoding === "utf-8" && looksBinary(start)) throw new LoadProblem(`${name} is not a point cloud this page knows. It opens ${FORMATS} files.`);
    const text = new TextDecoder(encoding).decode(data);
    return ending === "obj" || /^v[ \t]+[-+.\d]/m.test(start) ? readObj(name, text) : readXyz(name, text);
  } catch (error) {
    if (error instanceof LoadProblem) throw error;
    // Whatever a loader trips over, it was the file: a size, an offset or a number that cannot be.
    throw new LoadProblem(`${name} is broken and could not be read.`);
  }
}

/** By the mark at its beginning: some spreadsheets export text of two bytes a character. */
function encodingOf(data: ArrayBuffer): "utf-8" | "utf-16le" | "utf-16be" {
  const [first, second] = new Uint8Array(data, 0, Math.min(data.byteLength, 2));
  if (first === 0xff && second === 0xfe) return "utf-16le";
  return first === 0xfe && second === 0xff ? "utf-16be" : "utf-8";
}

/** Text has no control characters but tabs and line ends. */
function looksBinary(start: string): boolean {
   
  return /[\u0000-\u0008\u000e-\u001f]/.test(start);
}
