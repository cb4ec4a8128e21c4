// Clouds in general position in two to seven dimensions, from inside and from up to 10¹² cloud sizes away, against Qhull.
// Where the two differ, an exact linear program in integers says who is wrong (qhull.py).
import { spawn } from "node:child_process";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { init, PointCloud, type Visibility, type VisibilityOptions } from "hidden-point-removal";

import { randomNumbers } from "../package/support";
import { pythonWith } from "./python";

/** Qhull's hulls of more points take seconds and gigabytes. */
const MOST_POINTS = [0, 0, 300, 300, 300, 200, 100, 50];
/** The points of each view that are judged whether Qhull differs or not. */
const ANYWAY = 3;

interface View {
  dimension: number;
  place: string;
  positions: number[];
  viewpoint: number[];
  options: VisibilityOptions;
}

interface Judgement {
  refused: boolean;
  different: number;
  theirs: number;
  ours: number[];
}

/** Tries views for this many minutes and prints the counts. A view is wrong if a point is wrong by the exact program. */
export async function fuzzQhull(minutes: number, seed: number): Promise<{ tried: number; wrong: number }> {
  const python = pythonWith("qhull", ["numpy==2.4.6", "scipy==1.16.3"]);
  if (python === undefined) {
    console.log("skipped Qhull: there is no Python 3 with pip, or no PyPI");
    return { tried: 0, wrong: 0 };
  }
  await init();
  const judge = spawn(python, [join(import.meta.dirname, "qhull.py")], { stdio: ["pipe", "pipe", "inherit"] });
  const answers = createInterface({ input: judge.stdout })[Symbol.asyncIterator]();
  const sums = new Map<string, Record<string, number>>();
  const total = { tried: 0, wrong: 0 };
  const end = Date.now() + 60_000 * minutes;
  for (let round = seed; Date.now() < end; round++) {
    const view = randomView(randomNumbers(round));
    const { dimension, place, viewpoint, options } = view;
    const cloud = new PointCloud(view.positions, { dimension });
    const answer = cloud.visibleFrom(viewpoint, options);
    cloud.dispose();
    const flipped = flips(view, answer);
    const anyway = Array.from({ length: ANYWAY }, (_, k) => (round + 7 * k) % flipped.length);
    judge.stdin.write(`${JSON.stringify({ flipped, visible: [...answer.indices], anyway })}\n`);
    const line = await answers.next();
    if (line.done) throw new Error(`seed ${round}: the judge died`);
    const { refused, different, theirs, ours } = JSON.parse(line.value) as Judgement;
    total.tried++;
    if (ours.length > 0 || answer.count === 0) {
      total.wrong++;
      console.log(`seed ${round}: ${dimension}D, ${place}, ${JSON.stringify(options)}: points ${ours.join(" ")}`);
    }
    for (const title of [`${dimension}D`, place]) {
      const sum = sums.get(title) ?? {};
      sums.set(title, sum);
      const counts = {
        views: 1,
        points: flipped.length,
        empty: Number(answer.count === 0),
        inexact: Number(!answer.exact),
        "Qhull refuses": Number(refused),
        "views that differ": Number(different > 0),
        differences: different,
        "ours wrong": ours.length,
        "Qhull's wrong": theirs,
        "views with Qhull's wrong": Number(theirs > 0),
      };
      for (const [name, count] of Object.entries(counts)) sum[name] = (sum[name] ?? 0) + count;
    }
  }
  judge.kill();
  for (const [title, sum] of [...sums].sort(([a], [b]) => a.localeCompare(b, "en", { numeric: true }))) {
    const counts = Object.entries(sum).map(([name, count]) => `${name} ${count}`);
    console.log(`${title}: ${counts.join(", ")}`);
  }
  return total;
}

function randomView(random: () => number): View {
  const below = (count: number) => Math.floor(count * random());
  const normal = () => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
  const dimension = 2 + below(6);
  const direction = () => {
    const v = Array.from({ length: dimension }, normal);
    const length = Math.hypot(...v);
    return v.map((x) => x / length);
  };
  const point = [
    () => Array.from({ length: dimension }, () => 2 * random() - 1),
    () => Array.from({ length: dimension }, normal),
    direction,
  ][below(3)]!;
  const points = Array.from({ length: 10 + below(MOST_POINTS[dimension]! - 9) }, point);
  const size = 2 * Math.max(...points.map((p) => Math.hypot(...p)));
  const power = below(14) - 1;
  const distance = power < 0 ? 0.3 * size * random() : 10 ** power * size;
  const options = [
    (): VisibilityOptions => ({}),
    (): VisibilityOptions => ({ exponent: 1 + below(6) }),
    (): VisibilityOptions => ({ inversion: { exponential: "auto" } }),
    (): VisibilityOptions => ({ inversion: { exponential: size * 10 ** (-3 * random()) } }),
  ][below(4)]!();
  return {
    dimension,
    place: power < 0 ? "inside" : `10^${power} sizes`,
    positions: points.flat(),
    viewpoint: direction().map((x) => x * distance),
    options,
  };
}

/** The flips of the definition, operation by operation. V8's Math.exp has the bits of libm's; its Math.pow has not. */
function flips({ dimension, positions, viewpoint }: View, { inversion, radius }: Visibility): number[][] {
  return Array.from({ length: positions.length / dimension }, (_, i) => {
    const v = viewpoint.map((c, k) => positions[dimension * i + k]! - c);
    const d = Math.sqrt(v.reduce((sum, x) => sum + x * x, 0));
    if (inversion === "spherical") return v.map((x) => x * ((2 * radius - d) / d));
    const { exponential: c } = inversion as { exponential: number };
    return v.map((x) => x * (Math.exp(Math.min(c / d, 200)) / d));
  });
}
