import type { ChosenColumns } from "../../formats/axes.js";
import { readPcd } from "./pcd.js";
import { readPly } from "./ply.js";
import type { PointFile } from "./point-file.js";
import { readTable } from "./table.js";

/** The formats that can be read, by the ending of a file's name. */
export const FORMATS: Record<string, (file: Buffer, chosen?: ChosenColumns) => PointFile> = {
  ".ply": readPly,
  ".pcd": readPcd,
  ".xyz": readTable,
  ".txt": readTable,
  ".csv": readTable,
  ".pts": readTable,
};
