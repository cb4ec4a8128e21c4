import { CloudBuilder } from "./builder.js";
import type { CloudFile, Reading } from "./cloud-file.js";
import { FormatProblem } from "./problem.js";
import { step } from "./read-rows.js";
import { lines } from "./source.js";
import { cell } from "./table-words.js";
import { columnsSaid, isByte, isPlain, type Layout, rowsIn, TableRows } from "./table.js";
import { textOf } from "./text-source.js";

/** A column besides x, y and z. */
interface Other {
  name: string;
  column: number;
}

/** Enough points to guess the meaning of the other columns. */
const LOOK_AT = 200;
const COLORS = [/^(r|red)$/, /^(g|green)$/, /^(b|blue)$/];

/** Reads a table of points. table.ts says which lines it may have. */
export async function readTable(reading: Reading): Promise<CloudFile> {
  const rows = new TableRows(reading.chosen);
  const type = reading.single ? "float32" : "float64";
  const left: string[] = [];
  /** Below the first point, a line that is none is left out, if that is asked for. */
  const taken = (...given: Parameters<TableRows["take"]>) => {
    try {
      return rows.take(...given);
    } catch (error) {
      if (!(error instanceof FormatProblem) || rows.layout === undefined) throw error;
      error.rest = "without it";
      if (!reading.damaged) throw error;
      left.push(error.message);
      return undefined;
    }
  };
  let others: Other[] = [];
  let builder: CloudBuilder | undefined;
  for await (const { texts, number, end, places } of lines(await textOf(reading), 0)) {
    const at = reading.records ? places() : undefined;
    for (let line = 0; line < texts.length; line++) {
      const following = () => texts.slice(line, line + LOOK_AT);
      const point = taken(texts[line]!, number + line, following);
      if (point === undefined) continue;
      if (builder === undefined) {
        others = otherColumns(rows.layout!, rowsIn(following(), rows.layout!));
        const columns = others.map(({ name }) => ({ name, type }) as const);
        builder = new CloudBuilder("float64", columns, reading, null);
      }
      if (!builder.takes()) continue;
      const i = builder.put(...point.position);
      if (at) builder.place(i, at[line]!, at[line + 1]!);
      for (let k = 0; k < others.length; k++) {
        builder.values[k]![i] = cell(point.words[others[k]!.column]!)?.value ?? NaN;
      }
    }
    step(reading, end);
  }
  // Without a line, the number of points that the file promises is another one.
  if (left.length === 0 || builder === undefined) rows.finish();
  const layout = rows.layout!;
  const { width, axes, names } = layout;
  // Colors after the position are a sure sign, too, so nothing needs to be said.
  const areAxesPlain =
    isPlain(layout) || (names === undefined && axes[0] === 0 && others.some((other) => other.name === "red"));
  const read = [...axes, ...others.map(({ column }) => column)];
  const unread = Array.from({ length: width }, (_, column) => names?.written[column] ?? `column ${column + 1}`);
  const { notes, ...cloud } = builder!.finish();
  const what = left.length === 1 ? "one line is left out" : `${left.length} lines are left out, the first`;
  return {
    ...cloud,
    notes: left.length === 0 ? notes : [...notes, `${what}: ${left[0]!}`],
    columnsAt: axes.map((axis) => axis + 1),
    unread: unread.filter((_, column) => !read.includes(column)),
    axes: columnsSaid(layout),
    areAxesPlain,
  };
}

/**
 * The colors by their names. Without names, they are the last three columns after x y z or after x y z and an intensity,
 * if all values are bytes. Also the other columns of numbers.
 */
function otherColumns({ width, axes, names }: Layout, rows: readonly string[][]): Other[] {
  const bare = names?.bare ?? [];
  const named = COLORS.map((pattern) => bare.findIndex((name) => pattern.test(name)));
  const last = [width - 3, width - 2, width - 1];
  const between = width - 4 - Math.max(...axes);
  const unnamed = names === undefined && (between === 0 || between === 1);
  const bytes = unnamed && rows.every((row) => last.every((column) => isByte(row[column] ?? "")));
  const colors = !named.includes(-1) ? named : bytes ? last : [];
  const others = colors.map((column, channel) => ({ name: ["red", "green", "blue"][channel]!, column }));
  for (let column = 0; column < width; column++) {
    if (axes.includes(column) || colors.includes(column)) continue;
    const isNumber = rows.every((row) => cell(row[column] ?? "") !== undefined);
    if (isNumber) others.push({ name: bare[column] ?? `column ${column + 1}`, column });
  }
  return others;
}
