import type { Camera } from "../query/camera.js";
import { isDivisible } from "../query/queries.js";
import { viewSettings, type VisibilityOptions } from "../query/view-options.js";
import { WorkerPointCloud } from "../worker.js";
import { defaultWorkers, MAX_WORKERS } from "../worker/workers.js";
import type { PointFile } from "./formats/point-file.js";
import type { NamedViewpoint } from "./places.js";

/** What is asked of the cloud. */
export type Question = { options: VisibilityOptions; threshold: number | undefined } & (
  | { kind: "view"; viewpoint: number[] }
  | { kind: "camera"; camera: Camera }
  | { kind: "each" | "any" | "coverage"; viewpoints: NamedViewpoint[] }
);

export interface Answer {
  /** The name of the viewpoint, if each has an answer of its own. */
  name?: string;
  indices: Uint32Array;
  /** The number of all points. */
  length: number;
  /** The number of points without a position. */
  skipped: number;
  scores?: Float32Array;
  /** How many viewpoints see each point. Then `indices` are the points that at least one sees. */
  counts?: Uint32Array;
  /** What is probably wrong with the camera. */
  note?: string;
  image?: { pixels: Float32Array; depths: Float32Array };
}

/** Reports the share of the work that is done. */
type OnProgress = (share: number, doing: string) => void;

/**
 * Asks the cloud of a file, one answer after another. The cloud is in workers, so this thread can draw the
 * progress, and large clouds use several cores.
 */
export async function* ask(
  { positions }: PointFile,
  question: Question,
  workers: number | undefined,
  onProgress: OnProgress,
): AsyncGenerator<Answer> {
  const cloud = await WorkerPointCloud.create(positions, {
    nonFinite: "skip",
    transfer: true,
    workers: workers ?? (isShared(question) ? await defaultWorkers(positions.length / 3, MAX_WORKERS) : 1),
    onProgress: (share) => {
      onProgress(share / 2, "preparing");
    },
  });
  try {
    const { length, skipped } = cloud;
    onProgress(0.5, "looking");
    for await (const answer of answers(cloud, question, onProgress)) yield { ...answer, length, skipped };
  } finally {
    await cloud.dispose();
  }
}

/** Whether several workers can share the work: the viewpoints, or each view. */
function isShared({ kind, options }: Question): boolean {
  return kind === "any" || kind === "coverage" || isDivisible(3, viewSettings({ ...options }, 3));
}

async function* answers(
  cloud: WorkerPointCloud,
  question: Question,
  onProgress: OnProgress,
): AsyncGenerator<Omit<Answer, "length" | "skipped">> {
  const { options, threshold } = question;
  const from = async (viewpoint: number[]) => {
    const { indices, scores } = await cloud.visibleFrom(viewpoint, options);
    if (scores === undefined) return { indices };
    return { indices: threshold === undefined ? indices : atLeast(scores, threshold), scores };
  };
  switch (question.kind) {
    case "view":
      yield await from(question.viewpoint);
      return;
    case "camera": {
      const { indices, pixels, depths, note } = await cloud.visibleFromCamera(question.camera, options);
      yield { indices, image: { pixels, depths }, ...(note !== undefined && { note }) };
      return;
    }
    case "each":
      for (const [i, { name, viewpoint }] of question.viewpoints.entries()) {
        onProgress(0.5 + i / question.viewpoints.length / 2, "looking");
        yield { name, ...(await from(viewpoint)) };
      }
      return;
    case "any":
    case "coverage": {
      const counts = await cloud.coverage(
        question.viewpoints.map(({ viewpoint }) => viewpoint),
        {
          ...options,
          onProgress: (share) => {
            onProgress(0.5 + share / 2, "looking");
          },
        },
      );
      yield { indices: atLeast(counts, 1), counts };
    }
  }
}

/** The places of the numbers that reach a threshold. */
function atLeast(numbers: Float32Array | Uint32Array, threshold: number): Uint32Array {
  const found = new Uint32Array(numbers.length);
  let count = 0;
  numbers.forEach((number, index) => {
    if (number >= threshold) found[count++] = index;
  });
  return found.subarray(0, count);
}
