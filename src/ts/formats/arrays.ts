// Rows of binary numbers without a header of their own, or with a small one: KITTI's and nuScenes' scans (.bin), arrays of
// NumPy (.npy), and the points of COLMAP (points3D.bin).
import { axesOf } from "./axes.js";
import type { CloudFile, Reading } from "./cloud-file.js";
import type { NumberType } from "./numbers.js";
import { interleaved } from "./pcd.js";
import { Contradictions, FormatProblem, quoted } from "./problem.js";
import { checkEnd, endOfRows, otherColumns, readBinaryRows } from "./read-rows.js";
import { type Field, fieldsSaid, type Group, listsIn, rowBytes } from "./rows.js";
import { bytesSource, checkByteLength, viewOf } from "./source.js";
import { byteText } from "./text.js";

/** How the numbers of a file stand in it. */
interface Layout {
  group: Group;
  /** Where they begin, in bytes. */
  start: number;
  bigEndian?: boolean;
  /** Whether all values of a column come before all values of the next one. */
  byColumns?: boolean;
  note?: string;
}

const field = (name: string, type: NumberType): Field => ({ name, type, count: 1 });
const rows = (count: number, fields: readonly Field[]): Group => ({ name: "points", count, fields });

/** The longest header of an array that is read. */
const START = 1 << 16;

export async function readArrays(reading: Reading): Promise<CloudFile> {
  const { source, name } = reading;
  const start = await source.read(0, START);
  const isNumPy = start[0] === 0x93;
  const layout = isNumPy ? numPy(start) : isColmap(name) ? colmap(start) : scan(start, source.size, name);
  const { group, bigEndian, byColumns, note } = layout;
  const names = group.fields.map((each) => each.name);
  const axes = axesOf(names, reading.chosen);
  const found = new Contradictions(reading.damaged);
  const end = await endOfRows(reading, layout.start, group, !bigEndian, found);
  await checkEnd(source, end, group.name, found);
  const points = { group, axes, others: otherColumns(group, axes, (each) => each) };
  let cloud: CloudFile;
  if (byColumns === true) {
    checkByteLength(end);
    const bytes = interleaved(await source.read(layout.start, end), group, end < source.size ? 0 : group.count);
    cloud = await readBinaryRows({ ...reading, source: bytesSource(bytes) }, 0, points, !bigEndian);
  } else {
    cloud = await readBinaryRows(reading, layout.start, points, !bigEndian);
  }
  const notes = [...new Set([...cloud.notes, ...found.notes, ...(note === undefined ? [] : [note])])];
  return { ...cloud, notes, unread: listsIn(group), axes: fieldsSaid(group.fields, axes) };
}

/** Whether a file without a beginning of its own is one of these, by its name. */
export const isArray = (start: string, name: string): boolean => start.startsWith("\x93NUMPY") || /\.bin$/i.test(name);

const isColmap = (name: string) => /points3D\.bin$/i.test(name);

const COLMAP: readonly Field[] = [
  field("id", "uint64"),
  ...["x", "y", "z"].map((name) => field(name, "float64")),
  ...["red", "green", "blue"].map((name) => field(name, "uint8")),
  field("error", "float64"),
  { ...field("track", "uint64"), length: "uint64" },
];

function colmap(start: Uint8Array): Layout {
  if (start.length < 8) throw new FormatProblem("it is too short for COLMAP's points");
  return { group: rows(Number(viewOf(start).getBigUint64(0, true)), COLMAP), start: 8 };
}

/** Scans of KITTI have 4 floats for each point, those of nuScenes 5. The bytes say nothing else. */
function scan(start: Uint8Array, size: number, name: string): Layout {
  if (/(cameras|images)\.bin$/i.test(name)) throw new FormatProblem("it holds COLMAP's cameras; readCameras reads it");
  const view = viewOf(start);
  const floats = Array.from({ length: start.length >> 2 }, (_, i) => Math.abs(view.getFloat32(4 * i, true)));
  const each = [/\.pcd\.bin$/i.test(name) ? 5 : 4, 5].find((numbers) => size % (4 * numbers) === 0);
  // Other bytes make numbers of any size.
  if (each === undefined || size === 0 || floats.some((value) => value !== 0 && (value <= 1e-9 || value >= 1e9))) {
    throw new FormatProblem("it does not hold 4 or 5 floats for each point, as scans of KITTI and nuScenes do");
  }
  const names = ["x", "y", "z", "intensity", "ring"].slice(0, each);
  return {
    group: rows(
      size / (4 * each),
      names.map((one) => field(one, "float32")),
    ),
    start: 0,
    note: `each point is read as ${each} floats: ${names.join(", ")}`,
  };
}

const KINDS: Record<string, string> = { f: "float", i: "int", u: "uint" };

/** The header of an array: its type, its shape and the order of its numbers, as Python writes them. */
function numPy(start: Uint8Array): Layout {
  const wide = start[6]! > 1;
  const from = wide ? 12 : 10;
  const length =
    start.length < from ? START : wide ? viewOf(start).getUint32(8, true) : viewOf(start).getUint16(8, true);
  const text = byteText(start.subarray(from, from + length));
  const [, types] = /'descr':\s*('[^']*'|\[[^\]]*\])/.exec(text) ?? [];
  const [, order] = /'fortran_order':\s*(True|False)/.exec(text) ?? [];
  const [, sizes] = /'shape':\s*\(([\d, ]*)\)/.exec(text) ?? [];
  if (types === undefined || order === undefined || sizes === undefined || from + length > start.length) {
    throw new FormatProblem("its header of NumPy cannot be read");
  }
  const shape = sizes.split(",").flatMap((word) => (word.trim() === "" ? [] : [Number(word)]));
  const orders = new Set<string>();
  const typeIn = (written: string) => {
    const [, byteOrder, kind, bytes] = /^([<>|=])([fiu])(\d)$/.exec(written) ?? [];
    const type = `${KINDS[kind ?? ""] ?? ""}${8 * Number(bytes)}`;
    if (!/^(float(32|64)|u?int(8|16|32|64))$/.test(type)) {
      throw new FormatProblem(`its numbers have the type ${quoted(written)}, which is not read`);
    }
    if (byteOrder !== "|") orders.add(byteOrder!);
    return type as NumberType;
  };
  const isNamed = types.startsWith("[");
  const named = [...types.matchAll(/\(\s*'([^']*)',\s*('[^']*'|[^)]*)\)/g)];
  const width = isNamed ? 1 : (shape.at(-1) ?? 0);
  if (!isNamed && (shape.length < 2 || width < 3 || (width > 64 && shape[0]! < 10))) {
    throw new FormatProblem(`its shape is (${sizes}), and not (points, 3) or more columns`);
  }
  const usual = (i: number) => ["x", "y", "z"][i] ?? `column ${i + 1}`;
  const fields = isNamed
    ? named.map(([, name, type]) => field(name!, typeIn(type!.replaceAll("'", ""))))
    : Array.from({ length: width }, (_, i) => field(usual(i), typeIn(types.slice(1, -1))));
  if (orders.size > 1) throw new FormatProblem("its numbers have two orders of bytes");
  const count = shape.reduce((product, one) => product * one, 1) / width;
  if (!Number.isSafeInteger(count * rowBytes(fields))) throw new FormatProblem(`its shape is (${sizes})`);
  if (order === "True" && shape.length > 2) {
    throw new FormatProblem("its numbers stand column by column in three dimensions");
  }
  return {
    group: rows(count, fields),
    start: from + length,
    bigEndian: orders.has(">"),
    byColumns: order === "True" && !isNamed,
  };
}
