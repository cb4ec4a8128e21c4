import type { ChosenColumns } from "../../formats/axes.js";
import { readLas } from "./las.js";
import { readPcd } from "./pcd.js";
import { readPly } from "./ply.js";
import type { PointFile } from "./point-file.js";
import { readTable } from "./table.js";

interface Format {
  read: (file: Buffer, chosen?: ChosenColumns) => PointFile | Promise<PointFile>;
  /** Whether the user can choose the columns. */
  hasColumns: boolean;
  /** The endings of files that its points can be written to. */
  written: readonly string[];
}

const PLY: Format = { read: readPly, hasColumns: true, written: [".ply"] };
const PCD: Format = { read: readPcd, hasColumns: true, written: [".pcd"] };
const LAS: Format = { read: readLas, hasColumns: false, written: [".las"] };
const TABLE: Format = { read: readTable, hasColumns: true, written: [".xyz", ".txt", ".csv", ".pts"] };

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
};
