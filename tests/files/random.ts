// Random valid files, and random changes of files.
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { binary, literals, npy, packed, PLY_FORMATS, type Value } from "./valid";

export interface ValidFile {
  kind: string;
  name: string;
  content: Buffer;
  /** Undefined if only changes are tried. */
  points: number[] | undefined;
  /** Is done to changed files, which their checksums would refuse otherwise. */
  seal?: (file: Buffer) => Buffer;
}

/** The words that changes put into files. */
const WORDS = [
  "nan", "0x10", "1e999", "-", "", "NA", "1,5", "-7.25", "4", "0", "-1", "x", "y", "z", "X", "float", "int", "list uchar int",
  "property float y", "element vertex 2", "comment", "#", "end_header", "POINTS 3", "SIZE", "COUNT 1 1 1", "DATA ascii",
  "m", "id", "easting", ";", ",", "\t", "\n", "\r", "\r\n", "1 2 3", "99999999999999999999", "\u00a0", "é",
]; // prettier-ignore

/** Repeatable random numbers. */
export class Random {
  #state: number;

  constructor(seed: number) {
    this.#state = (seed * 2654435761 + 12345) >>> 0;
    for (let i = 0; i < 3; i++) this.below(2);
  }

  /** A whole number from 0 to less than `count`. */
  below(count: number): number {
    this.#state = (Math.imul(this.#state, 1664525) + 1013904223) >>> 0;
    return Math.floor((this.#state / 2 ** 32) * count);
  }

  of<T>(values: readonly T[]): T {
    return values[this.below(values.length)]!;
  }

  shuffled<T>(values: readonly T[]): T[] {
    const rest = [...values];
    return values.map(() => rest.splice(this.below(rest.length), 1)[0]!);
  }

  /** A copy with one to three changes. */
  changed(content: Buffer): Buffer {
    let changed = content;
    for (let changes = 1 + this.below(3); changes > 0; changes--) changed = this.#change(changed);
    return changed;
  }

  #change(content: Buffer): Buffer {
    const text = content.toString("latin1");
    const [from, to] = [this.below(text.length + 1), this.below(text.length + 1)].sort((a, b) => a - b) as [
      number,
      number,
    ];
    const word = () => Buffer.from(this.of(WORDS)).toString("latin1");
    const lines = text.split(/(?<=\n)/);
    const line = this.below(lines.length);
    const put = (start: number, end: number, by: string) => text.slice(0, start) + by + text.slice(end);
    const words = [...text.matchAll(/[^\s,;]+/g)];
    const [here, there] = [this.of(words), this.of(words)] as (RegExpExecArray | undefined)[];
    const made = [
      () => put(from, from + 1, ""),
      () => put(from, from, this.of(Array.from('0123456789.,;+-e \t\n#xyzN"\r'))),
      () => put(from, from + 1, this.of(Array.from("0123456789.,;+-e \t\n#xyz"))),
      () => put(from, from, word()),
      () => text.slice(0, from),
      () => (to - from < 40 ? put(from, to, "") : text),
      () => (to - from < 40 ? put(from, from, text.slice(from, to)) : text),
      () => lines.filter((_, i) => i !== line).join(""),
      () => lines.flatMap((each, i) => (i === line ? [each, each] : [each])).join(""),
      () => [...lines.slice(0, line), ...lines.slice(line + 1), lines[line]!].join(""),
      () => (here ? put(here.index, here.index + here[0].length, word()) : text),
      () => (here && there ? put(here.index, here.index + here[0].length, there[0]) : text),
      () => (here ? put(here.index, here.index + here[0].length, "") : text),
      () => text.replaceAll("\n", this.of(["\r\n", "\r", "\n\n"])),
    ];
    return Buffer.from(this.of(made)(), "latin1");
  }
}

/** A random number that single precision and a short text hold exactly. */
function someNumber(random: Random): number {
  return random.of([random.below(20) - 10, (random.below(4000) - 2000) / 8, random.below(2) + 0.5]);
}

export function validFile(random: Random): ValidFile {
  const rows = Array.from({ length: 1 + random.below(5) }, () => [0, 1, 2].map(() => someNumber(random)));
  const common = [plyFile, pcdFile, tableFile];
  return random.of([...common, ...common, ptxFile, e57File, npyFile, scanFile, colmapFile])(random, rows);
}

const KINDS = { f4: "Float32", f8: "Float64" } as const;

/** An array of NumPy: in any order of bytes and of numbers, flat or with names. */
function npyFile(random: Random, rows: readonly number[][]): ValidFile {
  const [order, type, width] = [random.of(["<", ">"]), random.of(["f4", "f8"] as const), 3 + random.below(3)];
  const table = rows.map((row, i) => [...row, i, 7].slice(0, width));
  const isNamed = random.below(3) === 0;
  const isFortran = !isNamed && random.below(3) === 0;
  const lines = isFortran ? table[0]!.map((_, column) => table.map((row) => row[column]!)) : table;
  const names = ["x", "y", "z", "red", "id"].slice(0, width).map((name) => `('${name}', '${order}${type}')`);
  const content = npy(
    isNamed ? `[${names.join(", ")}]` : `'${order}${type}'`,
    isNamed ? `${rows.length},` : `${rows.length}, ${width}`,
    binary(
      lines.flatMap((line) => line.map((value): Value => [value, KINDS[type]])),
      order === "<",
    ),
    isFortran ? "True" : "False",
  );
  return { kind: "NumPy", name: "fuzz.npy", content, points: rows.flat() };
}

/** A scan of KITTI or nuScenes. */
function scanFile(random: Random, rows: readonly number[][]): ValidFile {
  const [width, name] = random.of([[4, "fuzz.bin"], [5, "fuzz.pcd.bin"]] as const); // prettier-ignore
  const values = rows.flatMap((row, i) => [...row, 0.5, i].slice(0, width));
  const content = binary(values.map((value): Value => [value, "Float32"]), true); // prettier-ignore
  return { kind: "floats", name, content, points: rows.flat() };
}

/** Points of COLMAP, each with the cameras that saw it. */
function colmapFile(random: Random, rows: readonly number[][]): ValidFile {
  const isText = random.below(2) === 0;
  const tracks = rows.map((_, i) => Array.from({ length: 2 * (i % 3) }, (__, k) => k));
  const lines = rows.map((row, i) => [i + 1, ...row, i, 8, 9, 0.25, ...tracks[i]!].join(" "));
  const long = (value: number): Value[] => [[value, "Int32"], [0, "Int32"]]; // prettier-ignore
  const records = rows.flatMap((row, i): Value[] => [
    ...long(i + 1),
    ...row.map((value): Value => [value, "Float64"]),
    ...[i, 8, 9].map((value): Value => [value, "Uint8"]),
    [0.25, "Float64"],
    ...long(tracks[i]!.length / 2),
    ...tracks[i]!.map((value): Value => [value, "Int32"]),
  ]);
  const content = isText
    ? Buffer.from(
        [...(random.below(2) === 0 ? ["# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[]"] : []), ...lines, ""].join("\n"),
      )
    : binary([...long(rows.length), ...records], true);
  return { kind: "COLMAP", name: isText ? "points3D.txt" : "points3D.bin", content, points: rows.flat() };
}

/** One of the two scans that a test has made elsewhere. */
function e57File(random: Random): ValidFile {
  const name = random.of(["two-scans.e57", "polar.e57"]);
  const content = readFileSync(join(import.meta.dirname, "../browser/fixtures", name));
  const seal = (file: Buffer) => (random.below(2) === 0 ? file : Buffer.from(sealed(new Uint8Array(file))));
  return { kind: "E57", name: "fuzz.e57", content, points: undefined, seal };
}

/** The checksum of each page of 1,024 bytes of an E57 file, CRC-32C in the wrong byte order, is computed anew. */
export function sealed(file: Uint8Array): Uint8Array {
  for (let page = 0; page + 1024 <= file.length; page += 1024) {
    let sum = 0xffffffff;
    for (const byte of file.subarray(page, page + 1020)) {
      sum ^= byte;
      for (let bit = 0; bit < 8; bit++) sum = sum & 1 ? (sum >>> 1) ^ 0x82f63b78 : sum >>> 1;
    }
    new DataView(file.buffer, file.byteOffset).setUint32(page + 1020, ~sum);
  }
  return file;
}

/** Scans of one column. The second one is moved. */
function ptxFile(random: Random, rows: readonly number[][]): ValidFile {
  const width = random.of([3, 4, 7]);
  const scans = [[0, 0, 0], ...(random.below(2) === 0 ? [[0, 1, 2].map(() => someNumber(random))] : [])];
  const line = (row: readonly number[], i: number) => [...row, 0.5, i % 256, 7, 255].slice(0, width).join(" ");
  const text = scans.map(
    (move) =>
    ["1", `${rows.length}`, "0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 0 0 0", "0 1 0 0", "0 0 1 0", `${move.join(" ")} 1`, ...rows.map(line)].join("\n"), // prettier-ignore
  );
  const placed = (move: number[]) =>
    rows.flatMap((row) => row.map((x, axis) => (row.every((value) => value === 0) ? NaN : x + move[axis]!)));
  const points = scans.flatMap(placed);
  return { kind: "PTX", name: "fuzz.ptx", content: Buffer.from(`${text.join("\n")}\n`), points };
}

interface Extra {
  name: string;
  values: (row: number) => number[];
}

function extras(random: Random): Extra[] {
  const all: Extra[] = ["red", "time", "id"].map((name, i) => ({ name, values: (row) => [(row * (i + 3)) % 256] }));
  return all.slice(0, random.below(4));
}

function plyFile(random: Random, rows: readonly number[][]): ValidFile {
  const format = random.of(["ascii", "little", "big"] as const);
  const double = random.below(2) === 0;
  const seen = random.below(4) === 0;
  const columns = random.shuffled([
    ...["x", "y", "z"],
    ...extras(random).map(({ name }) => name),
    ...(seen ? ["seen"] : []),
  ]);
  const faces = random.below(3);
  const faceFirst = random.below(3) === 0;
  const property = (name: string) =>
    name === "seen"
      ? "property list uchar int seen"
      : `property ${/[xyz]/.test(name) ? (double ? "double" : "float") : "uchar"} ${name}`;
  const vertex = [`element vertex ${rows.length}`, ...columns.map(property)];
  const face = faces > 0 ? [`element face ${faces}`, "property list uchar int vertex_indices"] : [];
  const header = ["ply", `format ${PLY_FORMATS[format]} 1.0`, ...(faceFirst ? [...face, ...vertex] : [...vertex, ...face]), "end_header", ""].join("\n"); // prettier-ignore

  const real = double ? "Float64" : "Float32";
  const vertexRows = rows.map((row, i) =>
    columns.flatMap((name): Value[] => {
      const axis = ["x", "y", "z"].indexOf(name);
      if (axis >= 0) return [[row[axis]!, real]];
      if (name === "seen") return [[i % 3, "Uint8"], ...Array.from({ length: i % 3 }, (): Value => [i, "Int32"])];
      return [[(7 * i) % 256, "Uint8"]];
    }),
  );
  const faceRows = Array.from({ length: faces }, (_, i): Value[] => [
    [3, "Uint8"],
    ...[0, i, 0].map((corner): Value => [corner, "Int32"]),
  ]);
  const all = faceFirst ? [...faceRows, ...vertexRows] : [...vertexRows, ...faceRows];
  const body =
    format === "ascii"
      ? Buffer.from(all.map((row) => `${row.map(([value]) => value).join(" ")}\n`).join(""))
      : binary(all.flat(), format === "little");
  return {
    kind: `PLY ${format}`,
    name: "fuzz.ply",
    content: Buffer.concat([Buffer.from(header), body]),
    points: rows.flat(),
  };
}

function pcdFile(random: Random, rows: readonly number[][]): ValidFile {
  const data = random.of(["ascii", "binary", "binary_compressed"] as const);
  const double = random.below(2) === 0;
  const columns = random.shuffled(["x", "y", "z", ...extras(random).map(({ name }) => name), ...(random.below(3) === 0 ? ["_"] : [])]); // prettier-ignore
  const isAxis = (name: string) => /^[xyz]$/.test(name);
  const line = (word: string, of: (name: string) => string | number) => `${word} ${columns.map(of).join(" ")}`;
  const header = [
    "# .PCD v0.7",
    "VERSION 0.7",
    line("FIELDS", (name) => name),
    line("SIZE", (name) => (isAxis(name) ? (double ? 8 : 4) : 1)),
    line("TYPE", (name) => (isAxis(name) ? "F" : "U")),
    line("COUNT", (name) => (name === "_" ? 3 : 1)),
    `WIDTH ${rows.length}`,
    "HEIGHT 1",
    `POINTS ${rows.length}`,
    `DATA ${data}`,
    "",
  ].join("\n");
  const field = (name: string, row: readonly number[], i: number): Value[] => {
    const axis = ["x", "y", "z"].indexOf(name);
    if (axis >= 0) return [[row[axis]!, double ? "Float64" : "Float32"]];
    return Array.from({ length: name === "_" ? 3 : 1 }, (): Value => [(5 * i) % 256, "Uint8"]);
  };
  const byRow = rows.map((row, i) => columns.flatMap((name) => field(name, row, i)));
  const byColumn = binary(columns.flatMap((name) => rows.flatMap((row, i) => field(name, row, i))), true); // prettier-ignore
  const body =
    data === "ascii"
      ? Buffer.from(byRow.map((row) => `${row.map(([value]) => value).join(" ")}\n`).join(""))
      : data === "binary"
        ? binary(byRow.flat(), true)
        : packed(literals(byColumn), byColumn.length);
  return {
    kind: `PCD ${data}`,
    name: "fuzz.pcd",
    content: Buffer.concat([Buffer.from(header), body]),
    points: rows.flat(),
  };
}

function tableFile(random: Random, rows: readonly number[][]): ValidFile {
  const [separator, kind] = random.of([[" ", "spaces"], ["\t", "tabs"], [",", "commas"], [";", "semicolons"]] as const); // prettier-ignore
  const names = random.of(["none", "line", "comment"] as const);
  const axes: readonly string[] = random.of([["x", "y", "z"], ["Easting", "Northing", "Height"], ["E", "N", "H"], ["E", "N", "Z"], ["x_m", "y_m", "z_m"]] as const); // prettier-ignore
  const more = extras(random).map(({ name }) => name);
  const columns = names === "none" ? [...axes, ...more] : random.shuffled([...axes, ...more]);
  const decimalComma = separator !== "," && random.below(4) === 0;
  const written = (value: number) => (decimalComma ? String(value).replace(".", ",") : String(value));
  const lines = rows.map((row, i) =>
    columns.map((name) => (axes.indexOf(name) >= 0 ? written(row[axes.indexOf(name)]!) : `${i}`)).join(separator),
  );
  const head = [
    ...(random.below(5) === 0 ? [`${rows.length}`] : []),
    ...(random.below(5) === 0 ? ["# by the fuzzer", ""] : []),
    ...(names === "line" ? [columns.join(separator)] : []),
    ...(names === "comment" ? [`# ${columns.join(separator)}`] : []),
    ...(names === "line" && random.below(3) === 0 ? [columns.map(() => "m").join(separator)] : []),
  ];
  const end = random.of(["\n", "\r\n", "\r"]);
  return {
    kind: `table, ${kind}`,
    name: "fuzz.csv",
    content: Buffer.from([...head, ...lines, ""].join(end)),
    points: rows.flat(),
  };
}
