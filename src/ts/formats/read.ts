import { isArray, readArrays } from "./arrays.js";
import type { CloudFile, Format, Reading } from "./cloud-file.js";
import { withColors } from "./colors.js";
import { unpacked } from "./source.js";
import { FormatProblem } from "./problem.js";
import { readObj } from "./read-obj.js";
import { readPcd } from "./pcd.js";
import { readPly } from "./ply.js";
import { readPtx } from "./read-ptx.js";
import { readTable } from "./read-table.js";
import { byteText } from "./text.js";

/** How each format is read. The larger readers are loaded when they are needed. */
const READERS: Record<Format, (reading: Reading) => Promise<CloudFile>> = {
  las: async (reading) => (await import("./las/read-las.js")).readLas(reading),
  gltf: async (reading) => (await import("./read-gltf.js")).readGltf(reading),
  e57: async (reading) => (await import("./e57.js")).readE57(reading),
  array: readArrays,
  ply: readPly,
  pcd: readPcd,
  ptx: readPtx,
  obj: readObj,
  table: readTable,
};

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
  const start = byteText(data).replace(/^ï»¿/, "");
  const ending = /\.([a-z0-9]+)$/i.exec(name)?.[1]?.toLowerCase() ?? "";
  if (start.startsWith("LASF")) return "las";
  if (start.startsWith("glTF") || (ending === "gltf" && /^\s*\{/.test(start))) return "gltf";
  if (/^ply\s/.test(start)) return "ply";
  if (start.startsWith("ASTM-E57")) return "e57";
  // A comment of any file may mention PCD.
  if (/^(#\s*\.PCD\b|VERSION\s|FIELDS\s)/.test(start) || (ending === "pcd" && /^(VERSION|FIELDS)\s/im.test(start))) {
    return "pcd";
  }
  if (isArray(start, name)) return "array";
  const foreign = foreignFile(start);
  if (foreign !== undefined) throw new FormatProblem(foreign);
  if (ending === "ptx" || /^\d+\s*[\r\n]\s*\d+\s*[\r\n]/.test(start)) return "ptx";
  if (/^(ply|pcd|las|laz|gltf|glb|e57|npy)$/.test(ending)) {
    const format = { gltf: "glTF", glb: "GLB" }[ending] ?? ending.toUpperCase();
    throw new FormatProblem(`it does not begin like a ${format} file`);
  }
  return ending === "obj" || /^v[ \t]+[-+.\d]/m.test(start) ? "obj" : "table";
}

// Files that are not read: what they are, and the way out.

/** How files begin, in Latin-1. */
const BEGINNINGS: readonly (readonly [begins: RegExp, says: string])[] = [
  [/^PK\x03\x04/, "it is a ZIP archive; unpack it, and read the file in it"],
  [/^(7z\xbc\xaf|Rar!)/, "it is an archive; unpack it, and read the file in it"],
  [/^\x1f\x8b/, "it is packed twice with gzip; unpack it once"],
  [/^(BZh|\xfd7zXZ|\x28\xb5\x2f\xfd)/, "it is packed, but not with gzip; unpack it first"],
  [/^[^]{257}ustar/, "it is a TAR archive; unpack it, and read the file in it"],
  [/^(\xff\xd8\xff|\x89PNG|GIF8|RIFF[^]{4}WEBP|II\*\0|MM\0\*)/, "it is an image; images have no points"],
  [/^%PDF/, "it is a PDF document"],
  [/^(pnts|b3dm|i3dm|cmpt)/, "it is a tile of 3D Tiles; read the file from which the tiles were made"],
  [/^\x89HDF/, "it is an HDF5 file; export its points as PLY, LAS or text"],
  [/^#ROSBAG/, "it is a bag of ROS; export its clouds as PCD"],
  [/^(\xd4\xc3\xb2\xa1|\xa1\xb2\xc3\xd4|\x0a\x0d\x0d\x0a)/, "it is a capture of network packets; export its points as PCD, LAS or text"],
  [/^PAR1/, "it is a Parquet file; export its points as text"],
  [/^SQLite format 3/, "it is a database of SQLite"],
  [/^Kaydara FBX/, "it is an FBX file; export it as glTF, PLY or OBJ"],
  [/^DRACO/, "it is compressed with Draco; export it without that compression"],
  [/^\s*solid\b[^]*\bfacet\b/, "it is an STL file; export it as PLY or OBJ"],
  [/^\s*ncols\s+\d/i, "it is a grid of heights; export it as points x y z"],
  [/^\s*<(\?xml|!DOCTYPE|html)/i, "it is XML or a page of the web, and no points"],
  [/^\s*\{[^]*"dataType"\s*:\s*"(laszip|binary|zstandard)"/, "it is the index of an EPT octree; read one LAZ file of its folder ept-data, or convert it to COPC"],
  [/^\s*\{[^]*"(hierarchy|octreeDir|firstChunkSize)"/, "it is the index of a Potree octree; openOctree of hidden-point-removal/stream reads it"],
  [/^\s*\[\s*\{[^]*"img_name"/, "it holds the cameras of Gaussian splats, and no points"],
  [/^\s*\{[^]*"(frames|camera_angle_x)"/, "it holds cameras, and no points; readCameras reads it"],
  [/^\s*\{[^]*"asset"[^]*"version"/, "it is a glTF file; its name must end with .gltf"],
  [/^\s*[[{]/, "it is JSON, which has no points that are read"],
]; // prettier-ignore

/** What a file is that no reader of points takes. Undefined if it may be text. */
export function foreignFile(start: string): string | undefined {
  return BEGINNINGS.find(([begins]) => begins.test(start))?.[1];
}
