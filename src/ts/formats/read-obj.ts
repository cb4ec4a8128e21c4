import { CloudBuilder } from "./builder.js";
import type { CloudFile, Reading } from "./cloud-file.js";
import { isOutOfRange, numberIn } from "./numbers.js";
import { FormatProblem, lineProblem } from "./problem.js";
import { step } from "./read-rows.js";
import { lines, textOf } from "./source.js";
import { trimmed, wordsOf } from "./text.js";

/** The vertices of an OBJ file (“v x y z”, in some files with a color after them). Its faces are ignored. */
export async function readObj(reading: Reading): Promise<CloudFile> {
  const colors = ["red", "green", "blue"].map((name) => ({ name, type: "float32" }) as const);
  const builder = new CloudBuilder("float64", colors, reading, null);
  for await (const { texts, number, end } of lines(await textOf(reading), 0)) {
    for (const [i, text] of texts.entries()) {
      if (/^\s*v\s/.test(text)) putVertex(builder, text, number + i);
    }
    step(reading, end);
  }
  if (builder.rows === 0) throw new FormatProblem("it has no vertex lines (“v x y z”)");
  const { columns, ...cloud } = builder.finish();
  // An OBJ file may have colors for some of its vertices.
  const isColored = columns[0]!.values.some((value) => !Number.isNaN(value));
  return { ...cloud, columns: isColored ? columns : [] };
}

function putVertex(builder: CloudBuilder, text: string, number: number): void {
  const line = trimmed(text.replace(/#.*/, ""));
  const words = wordsOf(line);
  // The position may be followed by a weight, a color, or both.
  if (![4, 5, 7, 8].includes(words.length)) {
    throw lineProblem(number, `has ${words.length - 1} values, and a vertex has 3, 4, 6 or 7`, line);
  }
  const values = words.slice(1).map(numberIn);
  if (!values.every((value) => value !== undefined)) {
    throw lineProblem(number, "is not a point, a value is not a number", line);
  }
  if (values.some((value) => isOutOfRange(value))) throw lineProblem(number, "has a number out of range", line);
  if (!builder.takes()) return;
  const i = builder.put(values[0]!, values[1]!, values[2]!);
  const color = values.length >= 6 ? values.slice(-3) : [NaN, NaN, NaN];
  color.forEach((value, channel) => (builder.values[channel]![i] = value));
}
