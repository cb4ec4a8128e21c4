import type { ChosenColumns } from "../../formats/axes.js";
import { FormatProblem } from "../../formats/problem.js";
import { columnsSaid, TableRows } from "../../formats/table.js";
import { type Line, looksBinary, trimmed } from "../../formats/text.js";
import { LinePoints, linesOf } from "./lines.js";
import type { PointFile } from "./point-file.js";

/** XYZ, TXT, CSV and PTS: one point per line. The lines above the first point are kept. */
export function readTable(file: Buffer, chosen?: ChosenColumns): PointFile {
  checkEncoding(file.subarray(0, 4096));
  const head: Line[] = [];
  const rows = new TableRows(chosen);
  const points = new LinePoints(file);
  for (const line of linesOf(file)) {
    const point = rows.take(line.text, line.number);
    if (point !== undefined) points.add(line, point.position);
    else if (rows.layout === undefined) head.push(line);
  }
  rows.finish();
  return {
    positions: points.numbers.slice(),
    leftOut: [],
    columns: columnsSaid(rows.layout!),
    header: ({ length }) => Buffer.concat(head.map((line) => headLine(file, line, length))),
    records: points.records,
  };
}

function checkEncoding(start: Uint8Array): void {
  const mark = 256 * (start[0] ?? 0) + (start[1] ?? 0);
  if (mark === 0xfffe || mark === 0xfeff) throw new FormatProblem("it is text in UTF-16; save it in UTF-8");
  if (looksBinary(start)) throw new FormatProblem("it is not text");
}

/** A line of the head. A line that holds only the number of points gets the new number. */
function headLine(file: Buffer, { text, start, end }: Line, count: number): Uint8Array {
  const number = trimmed(text);
  if (!/^\d+$/.test(number)) return file.subarray(start, end);
  return Buffer.from(file.toString("latin1", start, end).replace(number, String(count)), "latin1");
}
