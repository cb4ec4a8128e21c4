import { coordinate, type Line, LinePoints, linesOf } from "./lines.js";
import { FileProblem, type PointFile } from "./point-file.js";

/** XYZ, TXT, CSV and PTS: one point a line. What stands above the first point is kept. */
export function readTable(file: Buffer): PointFile {
  const head: Line[] = [];
  const points = new LinePoints(file);
  let columns: number[] | undefined;
  for (const line of linesOf(file)) {
    if (line.text === "" || isComment(line)) {
      if (columns === undefined) head.push(line);
      continue;
    }
    columns ??= columnsOf(line, head);
    if (columns === undefined) {
      head.push(line);
      continue;
    }
    const words = split(line.text);
    points.add(
      line,
      columns.map((column) => words[column]),
    );
  }
  if (points.count === 0) throw new FileProblem("it has no lines with three numbers");
  return {
    positions: points.numbers.slice(),
    leftOut: [],
    header: (count) => Buffer.concat(head.map((line) => headLine(file, line, count))),
    records: points.records,
  };
}

function isComment({ text }: Line): boolean {
  return text.startsWith("#") || text.startsWith("//");
}

/** Which columns are x, y and z, where this line is the first point: those named so above it, or the first three. */
function columnsOf({ text }: Line, head: Line[]): number[] | undefined {
  const words = split(text);
  for (const { text: names } of head.slice(-1)) {
    const named = split(names.toLowerCase().replace(/^(#|\/\/)\s*/, ""));
    const columns = ["x", "y", "z"].map((axis) => named.indexOf(axis));
    if (!columns.includes(-1) && isPoint(words, columns)) return columns;
  }
  return isPoint(words, [0, 1, 2]) ? [0, 1, 2] : undefined;
}

function isPoint(words: string[], columns: number[]): boolean {
  return columns.every((column) => coordinate(words[column]) !== undefined);
}

function split(text: string): string[] {
  const separator = text.includes(";") ? ";" : text.includes(",") ? "," : /\s+/;
  return text.split(separator).map((word) => word.trim().replace(/^"(.*)"$/, "$1"));
}

/** A line of the head; one with nothing but the number of points gets the new one. */
function headLine(file: Buffer, { text, start, end }: Line, count: number): Uint8Array {
  if (!/^\d+$/.test(text)) return file.subarray(start, end);
  return Buffer.from(file.toString("latin1", start, end).replace(text, String(count)), "latin1");
}
