// How long a draft takes, and the share of the hidden points that it hides.
import { PointCloud, type VisibilityOptions } from "hidden-point-removal";

import { WrongAnswer } from "./check.js";
import { CLOUDS } from "./clouds.js";
import { median, type Row, type Table } from "./report.js";
import { orbit } from "./views.js";

const NAMES = ["dragon", "bumpy-1m", "bumpy-3m", "room"];
const SETTINGS: Record<string, VisibilityOptions> = {
  "exponent 2": { exponent: 2 },
  "exponent 3": { exponent: 3 },
  "exponent 4": { exponent: 4 },
  automatic: {},
};
const RUNS = 3;
const SAMPLE = 50_000;

/** Throws if a draft hides a visible point, or if the answer after a draft is not exact. */
export function timeDrafts(): Table {
  const rows: Row[] = [];
  for (const name of NAMES) {
    const made = CLOUDS[name]!()!;
    const cloud = new PointCloud(made.positions);
    const at = orbit(made);
    for (const [radius, options] of Object.entries(SETTINGS)) {
      console.error(`${name}, ${radius}: drafts…`);
      const times = { cold: [] as number[], draft: [] as number[], after: [] as number[], sample: [] as number[] };
      let found = 0;
      for (let run = 0; run <= RUNS; run++) {
        // Before each query the cloud is seen from the other side, so that nothing of the last view helps.
        cloud.visibleFrom(at(180), options);
        const cold = timed(() => cloud.visibleFrom(at(0), options));
        cloud.visibleFrom(at(180), options);
        const draft = timed(() => cloud.visibleFrom(at(0), { ...options, draft: true }));
        const after = timed(() => cloud.visibleFrom(at(0), options));
        cloud.visibleFrom(at(180), { ...options, sample: SAMPLE });
        const sample = timed(() => cloud.visibleFrom(at(0), { ...options, sample: SAMPLE }));
        found = shareFound(cold.answer.mask(), draft.answer.mask(), after.answer.mask(), name);
        // The first run is not counted.
        if (run === 0) continue;
        times.cold.push(cold.milliseconds);
        times.draft.push(draft.milliseconds);
        times.after.push(after.milliseconds);
        times.sample.push(sample.milliseconds);
      }
      const [cold, draft] = [median(times.cold), median(times.draft)];
      rows.push({
        cloud: name,
        radius,
        "cold ms": cold,
        "draft ms": draft,
        "draft ÷ cold": draft / cold,
        "hidden found %": 100 * found,
        "exact after it ms": median(times.after),
        "sample ms": median(times.sample),
      });
    }
    cloud.dispose();
  }
  const note =
    "Median milliseconds in Node, on one core. A draft shows all that is visible and hides so much of what is hidden; " +
    `the exact answer goes on from it. The last column: a sample of ${SAMPLE} points.`;
  return { title: "Drafts and samples", note, rows };
}

/** The share of the hidden points that a draft hides. */
function shareFound(cold: Uint8Array, draft: Uint8Array, after: Uint8Array, name: string): number {
  let [hidden, found] = [0, 0];
  cold.forEach((visible, i) => {
    if (after[i] !== visible || draft[i]! < visible) throw new WrongAnswer(`${name}: a draft hides point ${i}`);
    hidden += 1 - visible;
    found += 1 - draft[i]!;
  });
  return found / hidden;
}

function timed<T>(work: () => T): { answer: T; milliseconds: number } {
  const start = performance.now();
  const answer = work();
  return { answer, milliseconds: performance.now() - start };
}
