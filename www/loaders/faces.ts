import { bytesOf, numberReader } from "../../src/ts/formats/numbers.js";
import { endsEarly, FormatProblem } from "../../src/ts/formats/problem.js";
import { startsIn } from "../../src/ts/formats/text-rows.js";
import { trimmed, wordsOf } from "../../src/ts/formats/text.js";
import type { Reading } from "../../src/ts/formats/cloud-file.js";
import { LONGEST_PLY_HEADER, readPlyHeader } from "../../src/ts/formats/ply.js";
import { eachListRow, endOfRows } from "../../src/ts/formats/read-rows.js";
import { blobSource, lines } from "../../src/ts/formats/source.js";
import { problemOf } from "./problem.ts";

/** The faces of a PLY or an OBJ file, cut into triangles: three vertex indices each. */
export async function readFaces({ name, blob }: { name: string; blob: Blob }, vertices: number): Promise<Uint32Array> {
  const reading = { name, source: blobSource(blob) };
  const start = new TextDecoder("latin1").decode(await reading.source.read(0, 4));
  const triangles = new Triangles(vertices);
  try {
    await (start.startsWith("ply") ? readPlyFaces : readObjFaces)(reading, triangles);
  } catch (error) {
    throw error instanceof FormatProblem ? problemOf(name, error) : error;
  }
  return triangles.done();
}

class Triangles {
  readonly #corners: number[] = [];
  readonly #vertices: number;

  constructor(vertices: number) {
    this.#vertices = vertices;
  }

  /** A face is cut into a fan around its first corner. */
  addFace(corners: readonly number[]): void {
    if (!corners.every((corner) => corner >= 0 && corner < this.#vertices)) {
      throw new FormatProblem("it has faces whose points are missing");
    }
    for (let i = 2; i < corners.length; i++) this.#corners.push(corners[0]!, corners[i - 1]!, corners[i]!);
  }

  done(): Uint32Array {
    return Uint32Array.from(this.#corners);
  }
}

async function readPlyFaces(reading: Reading, triangles: Triangles): Promise<void> {
  const { format, elements, end, lines: headerLines } = readPlyHeader(await reading.source.read(0, LONGEST_PLY_HEADER));
  const at = elements.findIndex((element) => element.name === "face");
  const faces = elements[at]!;
  const { count, fields } = faces;
  const corners = fields.findIndex(({ name, length }) => length !== undefined && /^vertex_ind(ex|ices)$/.test(name));
  if (corners < 0) throw new FormatProblem("it does not say which points its faces have");

  if (format === "ascii") {
    let before = elements.slice(0, at).reduce((sum, element) => sum + element.count, 0);
    let found = 0;
    for await (const { texts, number } of lines(reading.source, end, headerLines.length + 1)) {
      for (const [i, text] of texts.entries()) {
        const line = trimmed(text);
        if (line === "" || before-- > 0 || found === count) continue;
        const words = wordsOf(line);
        const start = startsIn(fields, words, number + i, line)[corners]!;
        triangles.addFace(words.slice(start + 1, start + 1 + Number(words[start])).map(Number));
        found++;
      }
    }
    if (found < count) throw endsEarly(found, count, faces.name);
    return;
  }
  const littleEndian = format === "binary_little_endian";
  let start = end;
  for (const element of elements.slice(0, at)) start = await endOfRows(reading, start, element, littleEndian);
  const { type, length } = fields[corners]!;
  const readLength = numberReader(length!, 0, littleEndian);
  const readCorner = numberReader(type, bytesOf(length!), littleEndian);
  await eachListRow(reading, start, faces, littleEndian, (view, starts) => {
    const place = starts[corners]!;
    triangles.addFace(
      Array.from({ length: readLength(view, place) }, (_, i) => readCorner(view, place + i * bytesOf(type))),
    );
  });
}

/** An index counts from 1. A negative one counts backwards from the last vertex so far. */
async function readObjFaces(reading: Reading, triangles: Triangles): Promise<void> {
  let vertices = 0;
  for await (const { texts } of lines(reading.source, 0)) {
    for (const line of texts) {
      if (/^\s*v\s/.test(line)) vertices++;
      if (!/^\s*f\s/.test(line)) continue;
      const numbers = line
        .trim()
        .split(/\s+/)
        .slice(1)
        .map((corner) => Number.parseInt(corner, 10));
      triangles.addFace(numbers.map((number) => (number < 0 ? vertices + number : number - 1)));
    }
  }
}
