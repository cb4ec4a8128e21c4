// Errors against ray-traced visibility, kind of surface by kind.
import { median, type Row, type Table } from "../bench/report.js";
import { AUTOMATIC, METHODS } from "./methods.js";
import { type Score, score } from "./score.js";
import { generated, type Labelled, madeLater, scanned, unevenly } from "./truth.js";
import { HALVES } from "./uneven.js";

/** What the columns say. */
export const EXPLAINED =
  "False positives (FP: said to be visible, and are not), false negatives (FN) and their total in % of all points, means over " +
  "the views; how many times the error of the best R of each view that is, unless it is 0; and the hulls a view takes.";

/** Scanned and generated clouds. Without HPR_SHARED, only the generated ones. */
export async function fidelityTables(say: (message: string) => void): Promise<Table[]> {
  const halves: Table[] = [];
  for (const half of HALVES) {
    say(`Making surfaces that are sampled unevenly, ${half}…`);
    halves.push(...compared(`Unevenly sampled surfaces, ${half}`, await collected(unevenly(half)), say));
  }
  return [
    ...compared("Scanned surfaces", [...scanned()], say),
    ...compared("Generated surfaces", [...generated()], say),
    ...halves,
    ...compared("Unevenly sampled surfaces, made later", [...madeLater()], say),
  ];
}

async function collected<T>(items: AsyncIterable<T>): Promise<T[]> {
  const all: T[] = [];
  for await (const item of items) all.push(item);
  return all;
}

function compared(title: string, clouds: Labelled[], say: (message: string) => void): Table[] {
  if (clouds.length === 0) return [];
  const all = clouds.flatMap((labelled) => {
    say(`Scoring ${labelled.name}…`);
    return score(labelled, METHODS);
  });
  const views = all.filter(({ method }) => method === AUTOMATIC.name).length;
  return [{ title, note: `${clouds.length} clouds, ${views} views.`, rows: rows(all) }];
}

/** One row for each method, in their order. */
function rows(scores: Score[]): Row[] {
  const methods = new Set(scores.map(({ method }) => method));
  return [...methods].map((method) => {
    const views = scores.filter((score) => score.method === method);
    const ratios = views.flatMap(({ ratio }) => ratio ?? []);
    return {
      method,
      "FP %": mean(views.map(({ falsePositives }) => falsePositives)),
      "FN %": mean(views.map(({ falseNegatives }) => falseNegatives)),
      "total %": mean(views.map(({ total }) => total)),
      ...(ratios.length === 0
        ? { "worst total %": Math.max(...views.map(({ total }) => total)) }
        : { "÷ best R: mean": mean(ratios), median: median(ratios), worst: Math.max(...ratios) }),
      hulls: mean(views.map(({ hulls }) => hulls)),
    };
  });
}

function mean(values: number[]): number {
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}
