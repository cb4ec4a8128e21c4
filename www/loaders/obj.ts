import type { LoadedCloud } from "../cloud/cloud.ts";
import { lines, type Reading } from "./blocks.ts";
import { CloudBuilder } from "./builder.ts";
import { LoadProblem } from "./problem.ts";

/** The vertices of an OBJ file (“v x y z”, with a color behind in some), whatever faces it has. */
export async function readObj(reading: Reading, encoding: string): Promise<LoadedCloud> {
  const { name, limit } = reading;
  const builder = new CloudBuilder(
    "float64",
    ["red", "green", "blue"].map((column) => ({ name: column, type: "float32" })),
    limit,
    null,
  );
  let faces = false;
  for await (const some of lines(reading, 0, encoding)) {
    for (const text of some) {
      faces ||= /^\s*f\s/.test(text);
      if (!/^\s*v\s/.test(text) || !builder.takes()) continue;
      const line = text.trim();
      const words = line.split(/\s+/);
      if (words.length < 4)
        throw new LoadProblem(
          `${name} is broken: a vertex line has fewer than three numbers (“${line.slice(0, 40)}”).`,
        );
      const i = builder.put(Number(words[1]), Number(words[2]), Number(words[3]));
      // An OBJ file may color some vertices and not others: NaN there, and no color for the whole.
      for (let channel = 0; channel < 3; channel++)
        builder.values[channel]![i] = words.length >= 7 ? Number(words[4 + channel]) : NaN;
    }
  }
  if (builder.rows === 0) throw new LoadProblem(`${name} holds no points: it has no vertex lines (“v x y z”).`);
  const cloud = builder.finish();
  return { ...cloud, isMesh: faces && cloud.positions.length === 3 * builder.rows };
}
