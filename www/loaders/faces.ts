import { bytes, lines, type Reading } from "./blocks.ts";
import { bytesOf, numberReader } from "./numbers.ts";
import { passOver, type PlyElement, readPlyHeader } from "./ply.ts";
import { LoadProblem } from "./problem.ts";

/** The faces of a PLY or an OBJ file cut into triangles: three indices of its vertices each. */
export async function readFaces(reading: Reading, vertices: number): Promise<Uint32Array> {
  const start = new TextDecoder("latin1").decode(await bytes(reading.name, reading.blob, 0, 4));
  const triangles = new Triangles(reading.name, vertices);
  await (start.startsWith("ply") ? readPlyFaces : readObjFaces)(reading, triangles);
  return triangles.done();
}

class Triangles {
  readonly #corners: number[] = [];
  readonly #name: string;
  readonly #vertices: number;

  constructor(name: string, vertices: number) {
    this.#name = name;
    this.#vertices = vertices;
  }

  /** Cut from its first corner. */
  addFace(corners: readonly number[]): void {
    if (!corners.every((corner) => corner >= 0 && corner < this.#vertices))
      throw new LoadProblem(`${this.#name} has faces between points that it does not have`);
    for (let i = 2; i < corners.length; i++) this.#corners.push(corners[0]!, corners[i - 1]!, corners[i]!);
  }

  done(): Uint32Array {
    return Uint32Array.from(this.#corners);
  }
}

async function readPlyFaces(reading: Reading, triangles: Triangles): Promise<void> {
  const { name, blob } = reading;
  const { format, elements, end } = await readPlyHeader(reading);
  const at = elements.findIndex((element) => element.name === "face");
  const { count, properties } = elements[at]!;
  const isCorners = ({ name: called, list }: PlyElement["properties"][number]) =>
    list !== null && /^vertex_ind(ex|ices)$/.test(called);
  if (!properties.some(isCorners)) throw new LoadProblem(`${name} does not say which points its faces have`);

  if (format === "ascii") {
    let left = elements.slice(0, at).reduce((sum, element) => sum + element.count, 0);
    let read = 0;
    for await (const some of lines(reading, end)) {
      for (const line of some) {
        if (line.trim() === "" || left-- > 0 || read === count) continue;
        const words = line.trim().split(/\s+/).map(Number);
        let word = 0;
        for (const property of properties) {
          const length = property.list ? words[word++]! : 1;
          if (isCorners(property)) triangles.addFace(words.slice(word, word + length));
          word += length;
        }
        read++;
      }
    }
    if (read < count) throw new LoadProblem(`${name} ends before its last face`);
    return;
  }
  const littleEndian = format === "binary_little_endian";
  const start = await passOver(reading, end, elements.slice(0, at), littleEndian, count);
  const view = new DataView(await bytes(name, blob, start, blob.size));
  let place = 0;
  for (let face = 0; face < count; face++) {
    for (const property of properties) {
      const { type, list } = property;
      const length = list ? numberReader(list, 0, littleEndian)(view, place) : 1;
      place += list ? bytesOf(list) : 0;
      const corner = numberReader(type, 0, littleEndian);
      if (isCorners(property))
        triangles.addFace(Array.from({ length }, (_, i) => corner(view, place + i * bytesOf(type))));
      place += length * bytesOf(type);
    }
  }
}

/** Counted from 1, or backwards from the last vertex so far. */
async function readObjFaces(reading: Reading, triangles: Triangles): Promise<void> {
  let vertices = 0;
  for await (const some of lines(reading, 0)) {
    for (const line of some) {
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
