import type { LoadedCloud } from "../cloud/cloud.ts";
import { columnsSaid, isPlain, type Layout, rowWords, TableRows } from "../../src/ts/formats/table.js";
import { cell, isComment } from "../../src/ts/formats/table-words.js";
import { trimmed } from "../../src/ts/formats/text.js";
import { lines, type Reading } from "./blocks.ts";
import { CloudBuilder } from "./builder.ts";

/** A column besides x, y and z. */
interface Other {
  name: string;
  column: number;
}

/** Enough points to guess the meaning of the other columns. */
const LOOK_AT = 200;
const COLORS = [/^(r|red)$/, /^(g|green)$/, /^(b|blue)$/];

/** Reads a table of points. src/ts/formats/table.ts says which lines it may have. */
export async function readXyz(reading: Reading, encoding: string): Promise<LoadedCloud> {
  const { name } = reading;
  const rows = new TableRows();
  let others: Other[] = [];
  let builder: CloudBuilder | undefined;
  let number = 1;
  for await (const some of lines(reading, 0, { encoding })) {
    for (const [i, line] of some.entries()) {
      const point = rows.take(line, number++);
      if (point === undefined) continue;
      if (builder === undefined) {
        others = otherColumns(rows.layout!, sample(some.slice(i, i + LOOK_AT), rows.layout!));
        const columns = others.map((other) => ({ name: other.name, type: "float32" as const }));
        builder = new CloudBuilder("float64", columns, reading, null);
      }
      if (!builder.takes()) continue;
      const at = builder.put(...point.position);
      for (let k = 0; k < others.length; k++)
        builder.values[k]![at] = cell(point.words[others[k]!.column]!)?.value ?? NaN;
    }
  }
  rows.finish();
  const cloud = builder!.finish();
  const layout = rows.layout!;
  // Colors after the position are a sure sign, too, so no note is needed.
  const isSure = isPlain(layout) || (layout.names === undefined && others.some((other) => other.name === "red"));
  return isSure ? cloud : { ...cloud, notes: [`${name}: ${columnsSaid(layout)}.`, ...(cloud.notes ?? [])] };
}

/** The words of the first points. */
function sample(lines: readonly string[], layout: Layout): string[][] {
  return lines
    .filter((line) => trimmed(line) !== "" && !isComment(trimmed(line)))
    .map((line) => rowWords(line, layout) ?? []);
}

/**
 * The colors by their names. Without names, they are the last three of 6 columns (x y z r g b) or of 7 (with an
 * intensity before them), if all values are bytes. Also the other columns of numbers.
 */
function otherColumns({ width, axes, names }: Layout, rows: readonly string[][]): Other[] {
  const bare = names?.bare ?? [];
  const named = COLORS.map((pattern) => bare.findIndex((name) => pattern.test(name)));
  const last = [width - 3, width - 2, width - 1];
  const unnamed = names === undefined && (width === 6 || width === 7);
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

function isByte(word: string): boolean {
  return /^\d{1,3}$/.test(word) && Number(word) <= 255;
}
