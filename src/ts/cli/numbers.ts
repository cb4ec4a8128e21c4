import type { Answer } from "./ask.js";
import type { OutputFormat } from "./outputs.js";

type NumberList = Uint8Array | Uint32Array | Float32Array | Float64Array;

/** Numbers to write: one for each point, or a row for each visible point. */
interface Table {
  values: NumberList;
  /** The number of values in a row. */
  width: number;
  /** The names of the columns, if there are several. */
  names?: string;
  /** The type in NumPy's words. */
  type: string;
}

type NumberFormat = Exclude<OutputFormat, "points" | "vis">;

/** How many rows are made into one piece of text. */
const PIECE = 65_536;

/** The output with numbers instead of points. */
export function* numbersWritten(format: NumberFormat, answer: Answer, numpy: boolean): Generator<Uint8Array> {
  const { values, width, names, type } = tableOf(format, answer);
  const rows = values.length / width;
  if (numpy) {
    yield numpyHeader(type, names === undefined ? `(${rows},)` : `(${rows}, ${width})`);
    yield new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
    return;
  }
  if (names !== undefined) yield Buffer.from(`${names}\n`);
  for (let row = 0; row < rows; row += PIECE) {
    let text = "";
    for (let i = row; i < Math.min(row + PIECE, rows); i++) {
      text += `${Array.from(values.subarray(i * width, (i + 1) * width), spelled).join(",")}\n`;
    }
    yield Buffer.from(text);
  }
}

function tableOf(format: NumberFormat, answer: Answer): Table {
  const { indices, length } = answer;
  switch (format) {
    case "indices":
      return { values: indices, width: 1, type: "<u4" };
    case "mask": {
      const mask = new Uint8Array(length);
      for (const index of indices) mask[index] = 1;
      // As a mask of NumPy: points[mask].
      return { values: mask, width: 1, type: "|b1" };
    }
    case "scores":
      return { values: answer.scores!, width: 1, type: "<f4" };
    case "counts":
      return { values: answer.counts!, width: 1, type: "<u4" };
    case "colors": {
      const { values, channels } = answer.colors!;
      const names =
        channels === 3 ? "red,green,blue" : Array.from({ length: channels }, (_, c) => `value${c + 1}`).join();
      return { values, width: channels, names, type: "<f4" };
    }
    case "pixels": {
      const { pixels, depths } = answer.image!;
      const rows = new Float64Array(4 * indices.length);
      indices.forEach((index, i) => {
        rows.set([index, pixels[2 * i]!, pixels[2 * i + 1]!, depths[i]!], 4 * i);
      });
      return { values: rows, width: 4, names: "index,u,v,depth", type: "<f8" };
    }
  }
}

/** Single precision has 9 digits. Whole numbers below 2³² keep all of theirs. */
function spelled(value: number): string {
  return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(9)));
}

/** NumPy's file format, version 1.0: the whole header has a multiple of 64 bytes. */
function numpyHeader(type: string, shape: string): Uint8Array {
  const text = `{'descr': '${type}', 'fortran_order': False, 'shape': ${shape}, }`;
  const length = Math.ceil((10 + text.length + 1) / 64) * 64 - 10;
  const header = Buffer.alloc(10 + length, " ");
  header.write("\x93NUMPY\x01\x00", 0, "latin1");
  header.writeUInt16LE(length, 8);
  header.write(text, 10, "latin1");
  header.write("\n", 10 + length - 1, "latin1");
  return header;
}
