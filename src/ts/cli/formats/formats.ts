import { extname } from "node:path";

import type { ChosenColumns } from "../../formats/axes.js";
import type { CloudFile, Reading } from "../../formats/cloud-file.js";
import { readLas } from "../../formats/las/read-las.js";
import { readE57 } from "../../formats/e57.js";
import { readPcd } from "../../formats/read-pcd.js";
import { readPly } from "../../formats/read-ply.js";
import { readPtx } from "../../formats/read-ptx.js";
import { readTable } from "../../formats/read-table.js";
import { bytesSource } from "../../formats/source.js";
import { compileFiles } from "../../files/wasm.js";
import { CONVERTED } from "./convert.js";
import { lasFrame } from "./las.js";
import { pcdFrame } from "./pcd.js";
import { plyFrame } from "./ply.js";
import type { Frame, PointFile } from "./point-file.js";
import { tableFrame } from "./table.js";

interface Format {
  read: (reading: Reading) => Promise<CloudFile>;
  frame?: (file: Buffer, cloud: CloudFile, chosen?: ChosenColumns) => Frame;
  /** Whether the user can choose the columns. */
  hasColumns: boolean;
  /** The endings of files that its points are copied to, as they are. */
  written: readonly string[];
}

const PLY: Format = { read: readPly, frame: plyFrame, hasColumns: true, written: [".ply"] };
const PCD: Format = { read: readPcd, frame: pcdFrame, hasColumns: true, written: [".pcd"] };
const LAS: Format = { read: readLas, frame: lasFrame, hasColumns: false, written: [".las"] };
const TABLE: Format = {
  read: readTable,
  frame: tableFrame,
  hasColumns: true,
  written: [".xyz", ".txt", ".csv", ".pts"],
};
const E57: Format = { read: readE57, hasColumns: false, written: [] };
const PTX: Format = { read: readPtx, hasColumns: false, written: [] };

/** The formats that can be read, by the ending of a file's name. The ending of COPC is .copc.laz. */
export const FORMATS: Record<string, Format> = {
  ".ply": PLY,
  ".pcd": PCD,
  ".xyz": TABLE,
  ".txt": TABLE,
  ".csv": TABLE,
  ".pts": TABLE,
  ".las": LAS,
  ".laz": LAS,
  ".e57": E57,
  ".ptx": PTX,
};

/** The ending that tells the format of a file. `.gz` stands behind it. */
export function endingOf(name: string): string {
  return extname(name.replace(/\.gz$/i, "")).toLowerCase();
}

/** The ending of an output with points, and whether they are copied there. Undefined: it holds no points of this file. */
export function writtenAs(input: string, output: string): { ending: string; isCopy: boolean } | undefined {
  const { written } = FORMATS[endingOf(input)]!;
  const ending = output === "-" ? (written[0] ?? CONVERTED[0]!) : extname(output).toLowerCase();
  const isCopy = written.includes(ending);
  return isCopy || CONVERTED.includes(ending) ? { ending, isCopy } : undefined;
}

/** Reads the points of a file, with the bytes of each. */
export async function readPoints(
  { read, frame }: Format,
  file: Buffer<ArrayBuffer>,
  { chosen, damaged }: Pick<Reading, "chosen" | "damaged">,
): Promise<PointFile> {
  const cloud = await read({ name: "", source: bytesSource(file), records: true, chosen, damaged, wasm: compileFiles });
  const records = { ...cloud.records, bytes: cloud.records.bytes ?? file };
  return { ...cloud, ...frame?.(file, { ...cloud, records }, chosen), records };
}
