// What several cores would gain: the sectors of a view, asked one after another in the native build.
import { join } from "node:path";

import { CLOUDS } from "./clouds.js";
import { ask, root, writeCloud } from "./paths.js";
import type { Row, Table } from "./report.js";
import { orbit } from "./views.js";

/** Least milliseconds of the whole view, and of each sector of 2, 4 and 8. */
interface Divided {
  whole: number;
  sectors: number[][];
}

const NAMES = ["dragon", "bumpy-1m", "room"];
const EXPONENTS = [2, 3];
const RUNS = 5;

export function timeSectors(): Table {
  const rows: Row[] = [];
  for (const name of NAMES) {
    const cloud = CLOUDS[name]!()!;
    console.error(`${name}: sectors…`);
    const program = join(root, "target", "release", "bench_native");
    const input = EXPONENTS.map((exponent) => [exponent, RUNS, ...orbit(cloud)(0)].join(" ")).join("\n");
    const lines = ask(program, [...writeCloud(cloud), "sectors"], { input })!
      .trim()
      .split("\n");
    lines.forEach((line, i) => {
      const { whole, sectors } = JSON.parse(line) as Divided;
      for (const times of sectors) {
        const slowest = Math.max(...times);
        rows.push({
          cloud: name,
          exponent: EXPONENTS[i]!,
          sectors: times.length,
          "whole ms": whole,
          "slowest ms": slowest,
          "× faster": whole / slowest,
          "sum of work ÷ whole": times.reduce((sum, time) => sum + time, 0) / whole,
        });
      }
    });
  }
  const note =
    `Least milliseconds of ${RUNS} cold views in the native build. The sectors are asked one after another, each with ` +
    "memory that is reserved already: what as many cores would gain that do not slow each other down.";
  return { title: "Sectors of a view", note, rows };
}
