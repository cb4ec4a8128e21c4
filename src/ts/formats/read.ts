import type { CloudFile, Reading } from "./cloud-file.js";
import { withColors } from "./colors.js";
import { foreignFile } from "./foreign.js";
import { unpacked } from "./gzip.js";
import { FormatProblem } from "./problem.js";
import { readObj } from "./read-obj.js";
import { readPcd } from "./read-pcd.js";
import { readPly } from "./read-ply.js";
import { readPtx } from "./read-ptx.js";
import { readTable } from "./read-table.js";

/** How each format is read. The larger readers are loaded when they are needed. */
const READERS = {
  las: async (reading: Reading) => (await import("./las/read-las.js")).readLas(reading),
  gltf: async (reading: Reading) => (await import("./read-gltf.js")).readGltf(reading),
  e57: async (reading: Reading) => (await import("./e57.js")).readE57(reading),
  ply: readPly,
  pcd: readPcd,
  ptx: readPtx,
  obj: readObj,
  table: readTable,
};

export type Format = keyof typeof READERS;

/** Reads a file. Its first bytes show its format. If they do not, the ending of its name is used. */
export async function readFile(reading: Reading): Promise<CloudFile & { format: Format }> {
  try {
    const plain = await unpacked(reading);
    const format = formatOf(await plain.source.read(0, 4096), plain.name);
    return { ...withColors(await READERS[format](plain)), format };
  } catch (error) {
    // The allocation of an array that is too long.
    if (error instanceof RangeError) {
      throw new FormatProblem("it is broken, or there is too little memory for it", { cause: error });
    }
    throw error;
  }
}

function formatOf(data: Uint8Array, name: string): Format {
  const start = new TextDecoder("latin1").decode(data).replace(/^ï»¿/, "");
  const ending = /\.([a-z0-9]+)$/i.exec(name)?.[1]?.toLowerCase() ?? "";
  if (start.startsWith("LASF")) return "las";
  if (start.startsWith("glTF") || (ending === "gltf" && /^\s*\{/.test(start))) return "gltf";
  if (/^ply\s/.test(start)) return "ply";
  if (start.startsWith("ASTM-E57")) return "e57";
  // A comment of any file may mention PCD.
  if (/^(#\s*\.PCD\b|VERSION\s|FIELDS\s)/.test(start) || (ending === "pcd" && /^(VERSION|FIELDS)\s/im.test(start))) {
    return "pcd";
  }
  const foreign = foreignFile(start);
  if (foreign !== undefined) throw new FormatProblem(foreign);
  if (ending === "ptx" || /^\d+\s*[\r\n]\s*\d+\s*[\r\n]/.test(start)) return "ptx";
  if (/^(ply|pcd|las|laz|gltf|glb|e57)$/.test(ending)) {
    const format = { gltf: "glTF", glb: "GLB" }[ending] ?? ending.toUpperCase();
    throw new FormatProblem(`it does not begin like a ${format} file`);
  }
  return ending === "obj" || /^v[ \t]+[-+.\d]/m.test(start) ? "obj" : "table";
}
