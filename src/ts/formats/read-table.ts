import { CloudBuilder } from "./builder.js";
import type { CloudFile, Reading } from "./cloud-file.js";
import { Contradictions, lineProblem } from "./problem.js";
import { isOutOfRange } from "./numbers.js";
import { step } from "./read-rows.js";
import { lines, textOf } from "./source.js";
import { cell } from "./table-words.js";
import { columnsSaid, isByte, isPlain, type Layout, rowsIn, TableRows } from "./table.js";

/** A column besides x, y and z. */
interface Other {
  name: string;
  column: number;
}

/** Enough points to guess the meaning of the other columns. */
const LOOK_AT = 200;

/** Reads a table of points. table.ts says which lines it may have. */
export async function readTable(reading: Reading): Promise<CloudFile> {
  const rows = new TableRows(reading.chosen);
  const type = reading.single ? "float32" : "float64";
  const found = new Contradictions(reading.damaged);
  /** Below the first point, a line that is none is left out, if that is asked for. */
  const taken = (...given: Parameters<TableRows["take"]>) => {
    try {
      const point = rows.take(...given);
      return (
        point && { ...point, values: others.map(({ column }) => numberAt(point.words[column]!, column, given[1])) }
      );
    } catch (error) {
      if (rows.layout === undefined) throw error;
      found.leaveOut(error);
      return undefined;
    }
  };
  let others: Other[] = [];
  let builder: CloudBuilder | undefined;
  let isColmap = false;
  for await (const { texts: given, number, end, places } of lines(await textOf(reading), 0)) {
    if (number === 1 && (given[0]!.startsWith("# 3D point list") || /points3D\.txt$/i.test(reading.name))) {
      isColmap = true;
      rows.take("# id x y z red green blue error", 0, () => []);
    }
    const texts = isColmap ? given.map(withoutTrack) : given;
    const at = reading.records ? places() : undefined;
    for (let line = 0; line < texts.length; line++) {
      const following = () => texts.slice(line, line + LOOK_AT);
      let point = taken(texts[line]!, number + line, following);
      if (point === undefined) continue;
      if (builder === undefined) {
        others = otherColumns(rows.layout!, rowsIn(following(), rows.layout!));
        const columns = others.map(({ name }) => ({ name, type }) as const);
        builder = new CloudBuilder("float64", columns, reading, null);
        const values = others.map(({ column }) => numberAt(point!.words[column]!, column, number + line));
        point = { ...point, values };
      }
      if (!builder.takes()) continue;
      const i = builder.put(...point.position);
      if (at) builder.place(i, at[line]!, at[line + 1]!);
      for (let k = 0; k < others.length; k++) builder.values[k]![i] = point.values[k]!;
    }
    step(reading, end);
  }
  // Without a line, the number of points that the file promises is another one.
  if (found.linesLeftOut === 0 || builder === undefined) rows.finish(found);
  const layout = rows.layout!;
  const { width, axes, names } = layout;
  // Colors after the position are a sure sign, too, so nothing needs to be said.
  const areAxesPlain =
    isPlain(layout) || (names === undefined && axes[0] === 0 && others.some((other) => other.name === "red"));
  const read = [...axes, ...others.map(({ column }) => column)];
  const unread = Array.from({ length: width }, (_, column) => names?.written[column] ?? `column ${column + 1}`);
  const { notes, ...cloud } = builder!.finish();
  return {
    ...cloud,
    notes: [...notes, ...found.notes],
    columnsAt: axes.map((axis) => axis + 1),
    unread: unread.filter((_, column) => !read.includes(column)),
    axes: columnsSaid(layout),
    areAxesPlain,
  };
}

/** A line of COLMAP's points without the images that see the point, of which each has its own number. */
function withoutTrack(line: string): string {
  return line.startsWith("#") ? "#" : line.split(" ", 8).join(" ");
}

/** The number in a column besides x, y and z. A word that is none is missing. */
function numberAt(word: string, column: number, line: number): number {
  const value = cell(word)?.value ?? NaN;
  if (isOutOfRange(value)) throw lineProblem(line, `has a number out of range in column ${column + 1}`);
  return value;
}

/** All columns of numbers besides x, y and z. Without names, those that surely are colors are called so. */
function otherColumns(layout: Layout, rows: readonly string[][]): Other[] {
  const { width, axes, names } = layout;
  const colors = names === undefined ? unnamedColors(layout, rows) : [];
  const others = colors.map((column, channel) => ({ name: ["red", "green", "blue"][channel]!, column }));
  for (let column = 0; column < width; column++) {
    if (axes.includes(column) || colors.includes(column)) continue;
    const isNumber = rows.every((row) => cell(row[column] ?? "") !== undefined);
    if (isNumber) others.push({ name: names?.bare[column] ?? `column ${column + 1}`, column });
  }
  return others;
}

/**
 * Three columns of bytes after x y z, or after x y z and an intensity, at the end or before a normal; or after a normal, at the
 * end. A normal has the length 1 or 0. Before one more column, some are larger than the small counts of LAS.
 */
function unnamedColors({ width, axes }: Layout, rows: readonly string[][]): number[] {
  const first = Math.max(...axes) + 1;
  const three = (from: number) => [from, from + 1, from + 2];
  const areBytes = (from: number) =>
    from + 3 <= width && rows.every((row) => three(from).every((column) => isByte(row[column] ?? "")));
  const areNormals = (from: number) =>
    rows.every((row) => {
      const length = Math.hypot(...three(from).map((column) => cell(row[column] ?? "")?.value ?? NaN));
      return length === 0 || Math.abs(length - 1) < 0.02;
    });
  const arePlain = (from: number) => rows.some((row) => three(from).some((column) => Number(row[column]) > 31));
  for (const from of [first, first + 1]) {
    const after = width - from - 3;
    if (areBytes(from) && (after === 0 || (after === 3 && areNormals(from + 3)))) return three(from);
  }
  if (areBytes(first) && width === first + 4 && arePlain(first)) return three(first);
  const last = width - 3;
  return last - first >= 3 && last - first <= 4 && areBytes(last) && areNormals(last - 3) ? three(last) : [];
}
