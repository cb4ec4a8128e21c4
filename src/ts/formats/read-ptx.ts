import { CloudBuilder } from "./builder.js";
import { type CloudFile, type FileStation, type Place, type Reading, SCAN, scanColumns } from "./cloud-file.js";
import { Contradictions, endsEarly, FormatProblem, lineProblem } from "./problem.js";
import { countIn, fitsType, isOutOfRange, numberIn } from "./numbers.js";
import { step } from "./read-rows.js";
import { lines, textOf } from "./source.js";
import { trimmed, wordsOf } from "./text.js";

/** The lines above the points of a scan: columns, rows, the place and the axes of the scanner, and a matrix of four rows. */
const WIDTHS = [1, 1, 3, 3, 3, 3, 4, 4, 4, 4];
const MATRIX = 6;
const IDENTITY = "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1";

/** A scan whose points are being read. */
interface Scan {
  count: number;
  read: number;
  /** The rows of its matrix. The last one is the translation. */
  matrix: number[];
}

/**
 * PTX, the text of Leica's scanners: scans of rows and columns, one after another. Each point has x, y, z, an intensity and
 * maybe a color. The matrix takes them into the coordinates of all scans. 0 0 0 is a direction without a point.
 */
export async function readPtx(reading: Reading): Promise<CloudFile> {
  const stations: FileStation[] = [];
  const head: number[][] = [];
  let builder: CloudBuilder | undefined;
  let width = 0;
  let scan: Scan | undefined;
  const found = new Contradictions(reading.damaged);
  for await (const { texts, number, end } of lines(await textOf(reading), 0)) {
    for (const [i, text] of texts.entries()) {
      const line = trimmed(text);
      if (line === "") continue;
      if (scan === undefined || scan.read === scan.count) {
        head.push(headLine(line, number + i, WIDTHS[head.length]!));
        if (head.length < WIDTHS.length) continue;
        scan = scanOf(head, number + i);
        stations.push({ name: `scan ${stations.length + 1}`, viewpoint: viewpointOf(head, scan) });
        head.length = 0;
        continue;
      }
      if (builder === undefined) {
        width = wordsOf(line).length;
        if (![3, 4, 7].includes(width)) {
          throw lineProblem(number + i, `has ${width} values, and a point has 3, 4 or 7`, line);
        }
        builder = new CloudBuilder("float64", columnsOf(width), reading, null);
      }
      scan.read++;
      const values = valuesOf(line, number + i, width, found);
      if (values === undefined || !builder.takes()) continue;
      const at = builder.put(...placed(values, scan.matrix));
      builder.values[0]![at] = stations.length - 1;
      for (let k = 3; k < width; k++) builder.values[k - 2]![at] = values[k]!;
    }
    step(reading, end);
  }
  if (head.length > 0) found.add(`it ends after ${head.length} of the ${WIDTHS.length} lines above a scan`);
  if (scan && scan.read < scan.count) found.add(endsEarly(scan.read, scan.count, "points").message);
  if (builder === undefined) throw new FormatProblem("it has no points");
  const cloud = builder.finish();
  const columns = scanColumns(
    cloud.columns,
    stations.map(({ name }) => name),
  );
  return { ...cloud, notes: [...found.notes, ...cloud.notes], columns, isGrid: true, up: "z", stations };
}

function columnsOf(width: number) {
  const intensity = { name: "intensity", type: "float32" } as const;
  const colors = ["red", "green", "blue"].map((name) => ({ name, type: "uint8" }) as const);
  return [SCAN, ...(width > 3 ? [intensity] : []), ...(width > 4 ? colors : [])];
}

function headLine(line: string, number: number, width: number): number[] {
  const words = wordsOf(line);
  const values = words.map((word) => (width === 1 ? countIn(word) : numberIn(word)));
  if (words.length !== width || !values.every((value) => value !== undefined && Number.isFinite(value))) {
    const wanted = width === 1 ? "a number of rows or columns" : `${width} numbers`;
    throw lineProblem(number, `should have ${wanted}, above the points of a scan`, line);
  }
  return values as number[];
}

function scanOf(head: readonly number[][], number: number): Scan {
  const count = head[0]![0]! * head[1]![0]!;
  if (!Number.isSafeInteger(count)) throw lineProblem(number, "ends a head that promises too many points");
  const rows = head.slice(MATRIX);
  if (!rows.every((row, i) => row[3] === (i < 3 ? 0 : 1))) {
    throw lineProblem(number, "ends a matrix that does not only turn and move");
  }
  return { count, read: 0, matrix: rows.flat() };
}

/** The scanner stands at the origin of its points. If they were moved already, the third line says where. */
function viewpointOf(head: readonly number[][], { matrix }: Scan): Place {
  return matrix.join() === IDENTITY ? (head[2] as Place) : (matrix.slice(12, 15) as Place);
}

/** The numbers of a point. Undefined if the line is left out. */
function valuesOf(line: string, number: number, width: number, found: Contradictions): number[] | undefined {
  try {
    const words = wordsOf(line);
    if (words.length !== width) {
      throw lineProblem(number, `has ${words.length} values, and lines above have ${width}`, line);
    }
    const values = words.map((word) => valueIn(word, number, line));
    if (!values.slice(4).every((value) => fitsType(value, "uint8"))) {
      throw lineProblem(number, "has a color that is not from 0 to 255", line);
    }
    return values;
  } catch (error) {
    found.leaveOut(error);
    return undefined;
  }
}

function valueIn(word: string, number: number, line: string): number {
  const value = numberIn(word);
  if (value === undefined) throw lineProblem(number, "is not a point, a value is not a number", line);
  if (isOutOfRange(value)) throw lineProblem(number, "has a number out of range", line);
  return value;
}

function placed([x, y, z]: readonly number[], m: readonly number[]): Place {
  if (x === 0 && y === 0 && z === 0) return [NaN, NaN, NaN];
  return [0, 1, 2].map((k) => x! * m[k]! + y! * m[4 + k]! + z! * m[8 + k]! + m[12 + k]!) as Place;
}
