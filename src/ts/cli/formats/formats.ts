import { extname } from "node:path";

import type { ChosenColumns } from "../../formats/axes.js";
import type { CloudFile, Reading } from "../../formats/cloud-file.js";
import { DEGREES } from "../../formats/las/read-las.js";
import { FormatProblem } from "../../formats/problem.js";
import { type Format as Holds, readFile } from "../../formats/read.js";
import { bytesSource } from "../../formats/source.js";
import { compileFiles } from "../../files/wasm.js";
import { CONVERTED } from "./convert.js";
import { lasFrame } from "./las.js";
import { pcdFrame, plyFrame, type Frame, type PointFile, tableFrame } from "./frames.js";

interface Format {
  /** What the file must hold. */
  holds: Holds;
  frame?: (file: Buffer, cloud: CloudFile, chosen?: ChosenColumns) => Frame;
  /** Whether the user can choose the columns. */
  hasColumns: boolean;
  /** The endings of files that its points are copied to, as they are. */
  written: readonly string[];
}

const PLY: Format = { holds: "ply", frame: plyFrame, hasColumns: true, written: [".ply"] };
const PCD: Format = { holds: "pcd", frame: pcdFrame, hasColumns: true, written: [".pcd"] };
const LAS: Format = { holds: "las", frame: lasFrame, hasColumns: false, written: [".las"] };
const TABLE: Format = {
  holds: "table",
  frame: tableFrame,
  hasColumns: true,
  written: [".xyz", ".txt", ".csv", ".pts"],
};
const E57: Format = { holds: "e57", hasColumns: false, written: [] };
const PTX: Format = { holds: "ptx", hasColumns: false, written: [] };

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

const SAID: Readonly<Record<Holds, string>> = {
  ply: "PLY", pcd: "PCD", las: "LAS", e57: "E57", ptx: "PTX", obj: "OBJ", gltf: "glTF", table: "a table",
}; // prettier-ignore

/** Reads the points of a file, with the bytes of each. */
export async function readPoints(
  name: string,
  file: Buffer<ArrayBuffer>,
  { chosen, damaged }: Pick<Reading, "chosen" | "damaged">,
): Promise<PointFile> {
  const { holds, frame } = FORMATS[endingOf(name)]!;
  const source = bytesSource(file);
  const cloud = await readFile({ name, source, records: true, chosen, damaged, wasm: compileFiles });
  if (cloud.format !== holds) {
    throw new FormatProblem(`it is ${SAID[cloud.format]}, and its name says ${SAID[holds]}; give it another ending`);
  }
  if (cloud.crs?.isAngular) throw new FormatProblem(DEGREES);
  const records = { ...cloud.records, bytes: cloud.records.bytes ?? file };
  return { ...cloud, ...frame?.(file, { ...cloud, records }, chosen), records };
}
