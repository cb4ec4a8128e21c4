// How often answers are wrong on simulated lidar.
import { PointCloud } from "hidden-point-removal";

import type { Row, Table } from "../bench/report.js";
import { bounds } from "../bench/views.js";
import { type LidarScene, lidarScenes } from "./lidar.js";
import { FOR_LIDAR, type Method } from "./methods.js";
import { errorsOf } from "./score.js";

const EXPLAINED =
  "False positives, false negatives and their total in % of all points, means over the views; knowable: the total among points " +
  "other than those that only surfaces hide of which the cloud has no point; balanced: the mean of the shares of visible and of " +
  "hidden points that are found.";

/** The tables of all scenes together and of each alone. There are none without HPR_SHARED. */
export function lidarTables(say: (message: string) => void): Table[] {
  const scored = [...lidarScenes()].map((scene) => {
    say(`Scoring ${described(scene)}…`);
    return { scene, rows: scoredViews(scene) };
  });
  if (scored.length === 0) return [];
  const all = scored.flatMap(({ rows }) => rows);
  const views = all.length / FOR_LIDAR.length;
  const title = "Simulated lidar";
  return [
    { title, note: `${scored.length} scenes, ${views} views. ${EXPLAINED}`, rows: means(all) },
    ...scored.map(({ scene, rows }) => ({ title: `${title}: ${described(scene)}`, note: "", rows: means(rows) })),
  ];
}

interface ViewScore {
  method: string;
  numbers: Record<string, number>;
}

function scoredViews({ positions, views }: LidarScene): ViewScore[] {
  const { center, radius } = bounds({ positions });
  const cloud = new PointCloud(positions);
  try {
    return views.flatMap(({ viewpoint, seen, unknowable }) =>
      FOR_LIDAR.map((method: Method) => {
        const mask = method.ask({ cloud, positions, viewpoint, middle: center, diagonal: 2 * radius }).mask();
        const { falsePositives, falseNegatives, total } = errorsOf(mask, seen);
        const knowable = (labels: Uint8Array) => labels.filter((_, i) => unknowable[i] === 0);
        const visible = seen.reduce((sum, is) => sum + is, 0) / seen.length;
        const found = 1 - falseNegatives / 100 / visible;
        const leftOut = 1 - falsePositives / 100 / (1 - visible);
        return {
          method: method.name,
          numbers: {
            "FP %": falsePositives,
            "FN %": falseNegatives,
            "total %": total,
            "knowable %": errorsOf(knowable(mask), knowable(seen)).total,
            balanced: (found + leftOut) / 2,
          },
        };
      }),
    );
  } finally {
    cloud.dispose();
  }
}

function means(scores: ViewScore[]): Row[] {
  return FOR_LIDAR.map(({ name }) => {
    const of = scores.filter(({ method }) => method === name).map(({ numbers }) => numbers);
    const mean = (key: string) => of.reduce((sum, numbers) => sum + numbers[key]!, 0) / of.length;
    return { method: name, ...Object.fromEntries(Object.keys(of[0]!).map((key) => [key, mean(key)])) };
  });
}

function described({ name, positions, views }: LidarScene): string {
  return `${name}, ${(positions.length / 3).toLocaleString("en-US")} points, ${views.length} views`;
}
