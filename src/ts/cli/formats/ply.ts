import { type NumberType, reader, roomFor, sizeOf, viewOf } from "./binary.js";
import { LinePoints, linesOf } from "./lines.js";
import { type Element, type PlyHeader, type Property, readPlyHeader } from "./ply-header.js";
import { equalRecords, FileProblem, type PointFile } from "./point-file.js";

const AXES = ["x", "y", "z"];

/** PLY, ASCII and binary. Only the vertices are kept: faces would point to vertices that are gone. */
export function readPly(file: Buffer): PointFile {
  const header = readPlyHeader(file);
  const vertex = header.elements.find(({ name }) => name === "vertex");
  if (vertex === undefined) throw new FileProblem("it has no vertices");
  if (header.elements.some((one) => one !== vertex && one.name === "vertex"))
    throw new FileProblem("its PLY header tells of vertices twice");
  const axes = AXES.map((axis) => vertex.properties.find(({ name }) => name.toLowerCase() === axis));
  if (axes.some((axis) => axis?.length !== undefined || axis === undefined))
    throw new FileProblem("its vertices have no x, y and z");
  const types = axes.map((axis) => axis!.type);
  const read = header.format === "ascii" ? readText : readBinary;
  return {
    ...read(file, header, vertex, axes as Property[], types),
    leftOut: header.elements
      .filter((one) => one !== vertex && one.count > 0)
      .map(({ name, count }) => `${count} × ${name}`),
    header: (count) => Buffer.from(headerOf(header, count), "latin1"),
  };
}

function headerOf({ lines }: PlyHeader, count: number): string {
  const kept = lines.filter(({ element }) => element === undefined || element === "vertex");
  return kept.map(({ text }) => text.replace(/^(\s*element\s+vertex\s+)\d+/, `$1${count}`)).join("");
}

type Points = Pick<PointFile, "positions" | "records">;

function readText(file: Buffer, header: PlyHeader, vertex: Element, axes: Property[], types: NumberType[]): Points {
  let before = header.elements.slice(0, header.elements.indexOf(vertex)).reduce((sum, { count }) => sum + count, 0);
  const places = axes.map((axis) => vertex.properties.indexOf(axis));
  const hasLists = vertex.properties.some(({ length }) => length !== undefined);
  const points = new LinePoints(file);
  for (const line of linesOf(file, header.end, header.lineCount + 1)) {
    if (points.count === vertex.count) break;
    if (line.text === "") continue;
    if (before > 0) {
      before -= 1;
      continue;
    }
    const words = line.text.split(/\s+/);
    const columns = hasLists ? columnsOf(vertex, words) : undefined;
    points.add(
      line,
      places.map((place) => words[columns?.[place] ?? place]),
    );
  }
  if (points.count < vertex.count) throw endsEarly(vertex, points.count);
  const positions = roomFor(vertex.count, types);
  positions.set(points.numbers);
  return { positions, records: points.records };
}

/** In which column each property begins, where lists before it take more than one. */
function columnsOf({ properties }: Element, words: string[]): number[] {
  let column = 0;
  return properties.map(({ length }) => {
    const begins = column;
    column += length === undefined ? 1 : 1 + listLength(Number(words[column]));
    return begins;
  });
}

function readBinary(file: Buffer, header: PlyHeader, vertex: Element, axes: Property[], types: NumberType[]): Points {
  const view = viewOf(file);
  const little = header.format === "little";
  let start = header.end;
  for (const element of header.elements.slice(0, header.elements.indexOf(vertex)))
    start = endOf(view, element, start, little);
  // Before there is any room made for so many: a header may promise anything.
  const size = fixedSize(vertex.properties);
  const least = size ?? vertex.properties.length;
  if (start + least * vertex.count > file.length)
    throw endsEarly(vertex, Math.max(0, Math.floor((file.length - start) / least)));
  const readers = types.map((type) => reader(view, type, little));
  const positions = roomFor(vertex.count, types);
  const places = axes.map((axis) => vertex.properties.indexOf(axis));

  if (size !== undefined) {
    const offsets = places.map((place) => fixedSize(vertex.properties.slice(0, place))!);
    for (let i = 0; i < vertex.count; i++) {
      for (let axis = 0; axis < 3; axis++) positions[3 * i + axis] = readers[axis]!(start + i * size + offsets[axis]!);
    }
    return { positions, records: equalRecords(file, start, size) };
  }

  const starts = new Float64Array(vertex.count + 1).fill(start, 0, 1);
  for (let i = 0; i < vertex.count; i++) {
    const begins = walk(view, vertex.properties, starts[i]!, little);
    if (begins === undefined) throw endsEarly(vertex, i);
    for (let axis = 0; axis < 3; axis++) positions[3 * i + axis] = readers[axis]!(begins[places[axis]!]!);
    starts[i + 1] = begins.at(-1)!;
  }
  return { positions, records: { bytes: file, start: (i) => starts[i]!, end: (i) => starts[i + 1]! } };
}

/** Bytes that properties take, unless lists are among them. */
function fixedSize(properties: Property[]): number | undefined {
  return properties.some(({ length }) => length !== undefined)
    ? undefined
    : properties.reduce((sum, { type }) => sum + sizeOf(type), 0);
}

/** Where an element's data ends. */
function endOf(view: DataView, element: Element, start: number, little: boolean): number {
  const size = fixedSize(element.properties);
  if (size !== undefined) return start + size * element.count;
  let at = start;
  for (let i = 0; i < element.count; i++) {
    const begins = walk(view, element.properties, at, little);
    if (begins === undefined) throw endsEarly(element, i);
    at = begins.at(-1)!;
  }
  return at;
}

/** Where each property of one record begins, and where the record ends; undefined where the file ends first. */
function walk(view: DataView, properties: Property[], start: number, little: boolean): number[] | undefined {
  const begins: number[] = [];
  let at = start;
  for (const { type, length } of properties) {
    begins.push(at);
    let count = 1;
    if (length !== undefined) {
      if (at + sizeOf(length) > view.byteLength) return undefined;
      count = listLength(reader(view, length, little)(at));
      at += sizeOf(length);
    }
    at += count * sizeOf(type);
    if (at > view.byteLength) return undefined;
  }
  return [...begins, at];
}

function listLength(length: number): number {
  if (!Number.isInteger(length) || length < 0) throw new FileProblem(`the length of a list is ${length}`);
  return length;
}

function endsEarly({ name, count }: Element, found: number): FileProblem {
  return new FileProblem(`it ends after ${found} of the ${count} × ${name} that its header promises`);
}
