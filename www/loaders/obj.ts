import type { LoadedCloud } from "../cloud/cloud.ts";
import { numberIn } from "../../src/ts/formats/numbers.js";
import { lineProblem } from "../../src/ts/formats/problem.js";
import { trimmed, wordsOf } from "../../src/ts/formats/text.js";
import { lines, type Reading } from "./blocks.ts";
import { CloudBuilder } from "./builder.ts";
import { LoadProblem } from "./problem.ts";

/** The vertices of an OBJ file (“v x y z”, in some files with a color after them). Its faces are optional. */
export async function readObj(reading: Reading, encoding: string): Promise<LoadedCloud> {
  const { name } = reading;
  const builder = new CloudBuilder(
    "float64",
    ["red", "green", "blue"].map((column) => ({ name: column, type: "float32" })),
    reading,
    null,
  );
  let faces = false;
  let number = 0;
  for await (const some of lines(reading, 0, { encoding })) {
    for (const text of some) {
      number++;
      faces ||= /^\s*f\s/.test(text);
      if (!/^\s*v\s/.test(text)) continue;
      const line = trimmed(text.replace(/#.*/, ""));
      const words = wordsOf(line);
      // The position may be followed by a weight, a color, or both.
      if (![4, 5, 7, 8].includes(words.length))
        throw lineProblem(number, `has ${words.length - 1} values, and a vertex has 3, 4, 6 or 7`, line);
      const [x, y, z] = words.slice(1, 4).map(numberIn);
      if (x === undefined || y === undefined || z === undefined)
        throw lineProblem(number, "is not a point, a value is not a number", line);
      if (!builder.takes()) continue;
      const i = builder.put(x, y, z);
      // An OBJ file may have colors for only some vertices. The others get NaN, and then the whole cloud has no colors.
      for (let channel = 0; channel < 3; channel++)
        builder.values[channel]![i] = words.length >= 7 ? Number(words[words.length - 3 + channel]) : NaN;
    }
  }
  if (builder.rows === 0) throw new LoadProblem(`${name} holds no points: it has no vertex lines (“v x y z”).`);
  const cloud = builder.finish();
  return { ...cloud, isMesh: faces && cloud.positions.length === 3 * builder.rows };
}
