import type { CloudFile, Reading } from "./cloud-file.js";
import { unpacked } from "./gzip.js";
import { FormatProblem } from "./problem.js";
import { readObj } from "./read-obj.js";
import { readPcd } from "./read-pcd.js";
import { readPly } from "./read-ply.js";
import { readPtx } from "./read-ptx.js";
import { readTable } from "./read-table.js";

/** Reads a file. Its first bytes show its format. If they do not, the ending of its name is used. */
export async function readFile(reading: Reading): Promise<CloudFile> {
  try {
    return await readBy(await unpacked(reading));
  } catch (error) {
    // The allocation of an array that is too long.
    if (error instanceof RangeError) {
      throw new FormatProblem("it is broken, or there is too little memory for it", { cause: error });
    }
    throw error;
  }
}

/** The readers with dependencies are loaded when they are needed. */
async function readBy(reading: Reading): Promise<CloudFile> {
  const { name, source } = reading;
  const data = await source.read(0, 4096);
  const start = new TextDecoder("latin1").decode(data).replace(/^ï»¿/, "");
  const ending = /\.([a-z0-9]+)$/i.exec(name)?.[1]?.toLowerCase() ?? "";
  if (start.startsWith("LASF")) return (await import("./las/read-las.js")).readLas(reading);
  if (start.startsWith("glTF") || (ending === "gltf" && /^\s*\{/.test(start))) {
    return (await import("./read-gltf.js")).readGltf(reading);
  }
  if (/^ply\s/.test(start)) return readPly(reading);
  if (start.startsWith("ASTM-E57")) return (await import("./e57.js")).readE57(reading);
  // A comment of any file may mention PCD.
  if (/^(#\s*\.PCD\b|VERSION\s|FIELDS\s)/.test(start) || (ending === "pcd" && /^(VERSION|FIELDS)\s/im.test(start))) {
    return readPcd(reading);
  }
  if (ending === "ptx" || /^\d+\s*[\r\n]\s*\d+\s*[\r\n]/.test(start)) return readPtx(reading);
  if (/^(ply|pcd|las|laz|gltf|glb|e57)$/.test(ending)) {
    const format = { gltf: "glTF", glb: "GLB" }[ending] ?? ending.toUpperCase();
    throw new FormatProblem(`it does not begin like a ${format} file`);
  }
  const isObj = ending === "obj" || /^v[ \t]+[-+.\d]/m.test(start);
  return isObj ? readObj(reading) : readTable(reading);
}
