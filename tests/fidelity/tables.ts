// The fidelity tables, for `npm run bench -- --fidelity` and for tests/figures/FIDELITY.md.
import { median, type Row, type Table } from "../bench/report.js";
import { AGAINST_NOISE, AUTOMATIC, METHODS } from "./methods.js";
import { type Score, score } from "./score.js";
import { lidarTables } from "./lidar-tables.js";
import { scoreTables } from "./score-tables.js";
import { generated, type Labelled, madeLater, noisy, scanned, unevenly } from "./truth.js";
import { HALVES } from "./uneven.js";

const EXPLAINED =
  "False positives (FP: said to be visible, and are not), false negatives (FN) and their total in % of all points, means over " +
  "the views; how many times the error of the best R of each view that is, unless it is 0; and the hulls a view takes.";
const NOISE = 0.005;
const NOISE_SEED = 5;

/** The scanned clouds together and each alone, noise, then the generated clouds. Without HPR_SHARED, only the generated clouds. */
export async function fidelityTables(say: (message: string) => void): Promise<Table[]> {
  const scans = [...scanned()];
  const halves: Table[] = [];
  for (const half of HALVES) {
    say(`Making surfaces that are sampled unevenly, ${half}…`);
    halves.push(...compared(`Unevenly sampled surfaces, ${half}`, await collected(unevenly(half)), say));
  }
  return [
    ...compared("Scanned surfaces", scans, say),
    ...againstNoise(scans, say),
    ...compared("Generated surfaces", [...generated()], say),
    ...halves,
    ...compared("Unevenly sampled surfaces, made later", [...madeLater()], say),
    ...lidarTables(say),
    ...scoreTables(scans, say),
  ];
}

async function collected<T>(items: AsyncIterable<T>): Promise<T[]> {
  const all: T[] = [];
  for await (const item of items) all.push(item);
  return all;
}

function compared(title: string, clouds: Labelled[], say: (message: string) => void): Table[] {
  const scored = clouds.map((labelled) => {
    say(`Scoring ${described(labelled)}…`);
    return { labelled, scores: score(labelled, METHODS) };
  });
  if (scored.length === 0) return [];
  const all = scored.flatMap(({ scores }) => scores);
  const views = all.filter(({ method }) => method === AUTOMATIC.name).length;
  return [
    { title, note: `${clouds.length} clouds, ${views} views. ${EXPLAINED}`, rows: rows(all) },
    ...scored.map(({ labelled, scores }) => ({
      title: `${title}: ${described(labelled)}`,
      note: "",
      rows: rows(scores),
    })),
  ];
}

function againstNoise(clouds: Labelled[], say: (message: string) => void): Table[] {
  const bunny = clouds.find(({ name }) => name === "stanford-bunny");
  if (bunny === undefined) return [];
  const labelled = noisy(bunny, NOISE, NOISE_SEED);
  say(`Scoring ${described(labelled)}…`);
  const note =
    "Gaussian noise on every coordinate, its standard deviation in % of the box's diagonal; the truth is that of the points before.";
  return [{ title: `Noise: ${described(labelled)}`, note, rows: rows(score(labelled, AGAINST_NOISE, false)) }];
}

function described({ name, positions, views }: Labelled): string {
  return `${name}, ${(positions.length / 3).toLocaleString("en-US")} points, ${views.length} views`;
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
