import type { LoadedCloud } from "../cloud/cloud.ts";
import { FORMATS, listed } from "../settings/formats.ts";
import { FormatProblem } from "../../src/ts/formats/problem.js";
import { looksBinary } from "../../src/ts/formats/text.js";
import { bytes, type Reading } from "./blocks.ts";
import { LoadProblem, missingPart, problemOf } from "./problem.ts";

/** Reads a file. Its first bytes show its format. If they do not, the ending of its name is used. */
export async function readFile(reading: Reading, base: string | null): Promise<LoadedCloud> {
  const { name } = reading;
  try {
    return await readBy(reading, base);
  } catch (error) {
    if (error instanceof LoadProblem) throw error;
    if (error instanceof FormatProblem) throw problemOf(name, error);
    if (error instanceof TypeError && error.message.includes("import")) throw missingPart(name);
    if (error instanceof RangeError)
      throw new LoadProblem(`${name} could not be read: it is broken, or there is too little memory for it.`);
    // An unexpected error in a loader means that the file is broken: a size, an offset or a number is impossible.
    throw new LoadProblem(`${name} is broken and could not be read.`);
  }
}

/** Each reader is downloaded when it is needed. */
async function readBy(reading: Reading, base: string | null): Promise<LoadedCloud> {
  const { name, blob } = reading;
  const data = await bytes(name, blob, 0, 4096);
  const start = new TextDecoder("latin1").decode(data).replace(/^ï»¿/, "");
  const ending = /\.([a-z0-9]+)$/i.exec(name)?.[1]?.toLowerCase() ?? "";
  if (start.startsWith("LASF")) return (await import("./las/las.ts")).readLas(reading);
  if (start.startsWith("glTF") || (ending === "gltf" && /^\s*\{/.test(start)))
    return (await import("./gltf.ts")).readGltf(reading, base);
  if (/^ply\s/.test(start)) return (await import("./ply.ts")).readPly(reading);
  if (start.startsWith("ASTM-E57"))
    throw new LoadProblem(
      `${name} is an E57 file, which this page does not read: the one reader on npm, web-e57, was tried, and it gives all points as one text. Convert the file first, with CloudCompare or with “pdal translate ${name} cloud.laz”.`,
    );
  // A comment of any file may mention PCD.
  if (/^(#\s*\.PCD\b|VERSION\s|FIELDS\s)/.test(start) || (ending === "pcd" && /^(VERSION|FIELDS)\s/im.test(start)))
    return (await import("./pcd.ts")).readPcd(reading);
  if (/^(ply|pcd|las|laz|gltf|glb)$/.test(ending)) {
    const format = { gltf: "glTF", glb: "GLB" }[ending] ?? ending.toUpperCase();
    throw new LoadProblem(`${name} is not a point cloud: it does not begin like a ${format} file.`);
  }
  const encoding = encodingOf(data);
  if (encoding === "utf-8" && looksBinary(new Uint8Array(data)))
    throw new LoadProblem(
      `${name} is not a point cloud that this page knows. It opens ${listed(FORMATS, "and")} files.`,
    );
  const isObj = ending === "obj" || /^v[ \t]+[-+.\d]/m.test(start);
  return isObj
    ? (await import("./obj.ts")).readObj(reading, encoding)
    : (await import("./xyz.ts")).readXyz(reading, encoding);
}

/** The encoding by the byte order mark: some spreadsheets export text with two bytes for each character. */
function encodingOf(data: ArrayBuffer): "utf-8" | "utf-16le" | "utf-16be" {
  const [first, second] = new Uint8Array(data, 0, Math.min(data.byteLength, 2));
  if (first === 0xff && second === 0xfe) return "utf-16le";
  return first === 0xfe && second === 0xff ? "utf-16be" : "utf-8";
}
