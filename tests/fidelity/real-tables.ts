// How often answers are wrong on labeled scans, and how well scores serve as probabilities there.
import { PointCloud, type VisibilityOptions } from "hidden-point-removal";

import type { Row, Table } from "../bench/report.js";
import { bounds } from "../bench/views.js";
import { calibrationError, rankedRight } from "./calibration.js";
import { judged, type Judged, type JudgedView } from "./judged.js";
import { buffered } from "./rivals.js";
import { zBuffered } from "./z-buffer.js";

const EXPLAINED =
  "Wrong points in % of the judged ones (hidden points that are shown, in % of the hidden / visible points that are lost, in % " +
  "of the visible) and the mean of the two shares, means over the views. Scans are mostly visible: judge both shares. The z-buffer of splats " +
  "is in units of the spacing; the other one keeps the nearest range of each cell of 8 px (585 px focal length), + 5 cm + 2 %, only where the " +
  "unit is the meter.";
/** One pixel of the camera of 7-Scenes, in radians. */
const PIXEL = 1 / 585;

type Ask = (cloud: PointCloud, of: Judged, view: JudgedView) => Uint8Array | undefined;

const METHODS: Record<string, Ask> = {
  automatic: by({}),
  "looks: 3": by({ looks: 3 }),
  "thickness: 0": by({ looks: 3, thickness: 0 }),
  "z-buffer of splats": (cloud, { positions }, { viewpoint }) => zBuffered(positions, viewpoint, cloud.spacing),
  "z-buffer 8 px, .05 m": (_, { positions, isMetric }, { viewpoint }) =>
    isMetric ? buffered(positions, viewpoint, 8 * PIXEL, 0.05) : undefined,
  "exponent: 4": by({ exponent: 4 }),
  "R = 100 diagonals": diagonals(100),
  "R = 300 diagonals": diagonals(300),
};

function diagonals(times: number): Ask {
  return (cloud, { positions }, { viewpoint }) =>
    cloud.visibleFrom(viewpoint, { radius: 2 * times * bounds({ positions }).radius }).mask();
}

function by(options: VisibilityOptions): Ask {
  return (cloud, _, { viewpoint }) => cloud.visibleFrom(viewpoint, options).mask();
}

type Wrong = [all: number, shown: number, lost: number];

/** In %. Where there is no hidden point, none is shown. */
export function wrongOf(mask: Uint8Array, labels: Uint8Array): Wrong {
  const [all, wrong] = [
    [0, 0],
    [0, 0],
  ];
  labels.forEach((label, i) => {
    if (label > 1) return;
    all[label]!++;
    if (mask[i] !== label) wrong[label]!++;
  });
  const share = (part: number, of: number) => (100 * part) / Math.max(of, 1);
  const [shown, lost] = [share(wrong[0]!, all[0]!), share(wrong[1]!, all[1]!)];
  return [share(wrong[0]! + wrong[1]!, all[0]! + all[1]!), shown, lost];
}

interface Scored {
  row: string;
  half: number;
  wrong: Record<string, Wrong | undefined>;
  scores: Float64Array;
  labels: Uint8Array;
}

/** One table for each half of the views, and one of the scores, of the clouds with these parts of names. None without HPR_SHARED. */
export function realTables(parts: string[], say: (message: string) => void): Table[] {
  const scored = [...judged()].flatMap((of) => {
    if (parts.length > 0 && !parts.some((part) => of.name.includes(part))) return [];
    say(`Scoring ${of.name}…`);
    return scoredViews(of);
  });
  if (scored.length === 0) return [];
  const rows = [...new Set(scored.map(({ row }) => row))];
  const table = (half: number) =>
    rows.flatMap((row): Row[] => {
      const views = scored.filter((view) => view.row === row && view.half === half);
      if (views.length === 0) return [];
      const cells = Object.keys(METHODS).map((name) => [name, cell(views.map(({ wrong }) => wrong[name]))]);
      return [{ data: row, views: views.length, ...(Object.fromEntries(cells) as Row) }];
    });
  return [
    { title: "Reported: the half on which nothing was chosen", note: EXPLAINED, rows: table(1) },
    { title: "The half on which rules were chosen", note: "", rows: table(0) },
    {
      title: "Scores of three looks",
      note:
        "Calibration error: points in 20 bins of equal width by score; the mean distance of a bin's share of visible points " +
        "from its mean score. AUC: how often a visible point has a higher score than a hidden one.",
      rows: rows.flatMap((row) => scoresRow(scored.filter((view) => view.row === row))),
    },
  ];
}

function scoredViews(of: Judged): Scored[] {
  const cloud = new PointCloud(of.positions);
  try {
    return of.views.map((view) => {
      const wrong = Object.entries(METHODS).map(([name, ask]) => {
        const mask = ask(cloud, of, view);
        return [name, mask === undefined ? undefined : wrongOf(mask, view.labels)];
      });
      const { scores } = cloud.visibleFrom(view.viewpoint, { looks: 3, scores: true });
      const isJudged = (_: number, i: number) => view.labels[i]! < 2;
      return {
        row: of.row,
        half: view.half,
        wrong: Object.fromEntries(wrong) as Scored["wrong"],
        scores: Float64Array.from(scores.filter(isJudged)),
        labels: view.labels.filter(isJudged),
      };
    });
  } finally {
    cloud.dispose();
  }
}

function cell(all: (Wrong | undefined)[]): string {
  const known = all.filter((wrong) => wrong !== undefined);
  if (known.length < all.length) return "";
  const mean = (k: number) => (known.reduce((sum, one) => sum + one[k]!, 0) / known.length).toFixed(1);
  const [wrong, shown, lost] = [0, 1, 2].map(mean);
  const balanced = ((Number(shown) + Number(lost)) / 2).toFixed(1);
  return `${wrong!} (${shown!} / ${lost!}) ${balanced}`;
}

function scoresRow(views: Scored[]): Row[] {
  const columns = [1, 0].flatMap((half): [string, string][] => {
    const of = views.filter((view) => view.half === half);
    if (of.length === 0) return [];
    const scores = Float64Array.from(of.flatMap(({ scores }) => [...scores]));
    const labels = Uint8Array.from(of.flatMap(({ labels }) => [...labels]));
    const name = half === 1 ? "reported" : "chosen on";
    const auc = rankedRight(scores, labels);
    return [
      [`calibration error, ${name}`, calibrationError(scores, labels).toFixed(3)],
      [`AUC, ${name}`, Number.isNaN(auc) ? "" : auc.toFixed(3)],
    ];
  });
  return [{ data: views[0]!.row, ...Object.fromEntries(columns) }];
}
