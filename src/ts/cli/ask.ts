import { transfer, type TransferOptions, type Transferred } from "../cloud/transfer.js";
import { type ImageCamera, isCamera } from "../query/camera.js";
import type { SeenBy } from "../query/surveys.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { WorkerPointCloud } from "../worker.js";
import { defaultWorkers } from "../worker/team.js";
import type { PointFile } from "./formats.js";
import { readImage } from "./images.js";
import type { NamedCamera, NamedSeat } from "./places.js";

/** What is asked of the cloud. */
export type Question = { options: VisibilityOptions; threshold: number | undefined } & (
  | { kind: "view"; seats: [NamedSeat] }
  | { kind: "each" | "any" | "coverage"; seats: NamedSeat[] }
  | { kind: "rows"; seats: NamedCamera[] }
  | ({ kind: "colors"; seats: NamedCamera[]; images: string } & Pick<TransferOptions, "merge" | "weights">)
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
  /** Which cameras see each point. */
  rows?: SeenBy;
  /** What images say of each point. Then `indices` are the points that at least one camera sees. */
  colors?: Transferred;
  /** What is probably wrong with the camera. */
  note?: string | undefined;
  image?: { pixels: Float32Array; depths: Float32Array };
}

/** Reports the share of the work that is done. */
type OnProgress = (share: number, doing: string) => void;

/**
 * Asks the cloud of a file, one answer after another. The cloud is in workers, so this thread can draw the
 * progress, and several cores share many viewpoints.
 */
export async function* ask(
  { positions }: PointFile,
  question: Question,
  workers: number | undefined,
  onProgress: OnProgress,
): AsyncGenerator<Answer> {
  const cloud = await WorkerPointCloud.create(positions, {
    nonFinite: "skip",
    // The output needs the positions again.
    transfer: question.kind !== "colors",
    workers: workers ?? (sharesViewpoints(question) ? await defaultWorkers(positions.length / 3) : 1),
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

/** Workers share the viewpoints of one question. */
function sharesViewpoints({ kind }: Question): boolean {
  return kind !== "view" && kind !== "each";
}

async function* answers(
  cloud: WorkerPointCloud,
  question: Question,
  onProgress: OnProgress,
): AsyncGenerator<Omit<Answer, "length" | "skipped">> {
  const { options, threshold } = question;
  const from = async (seat: number[] | ImageCamera) => {
    if (isCamera(seat)) {
      const { indices, pixels, depths, note } = await cloud.visibleFromCamera(seat as ImageCamera, options);
      return { indices, image: { pixels, depths }, note };
    }
    const { indices, scores } = await cloud.visibleFrom(seat as number[], options);
    if (scores === undefined) return { indices };
    return { indices: threshold === undefined ? indices : atLeast(scores, threshold), scores };
  };
  const listening = {
    ...options,
    onProgress: (share: number) => {
      onProgress(0.5 + share / 2, "looking");
    },
  };
  switch (question.kind) {
    case "view":
      yield await from(question.seats[0].seat);
      return;
    case "each":
      for (const [i, { name, seat }] of question.seats.entries()) {
        onProgress(0.5 + i / question.seats.length / 2, "looking");
        yield { name, ...(await from(seat)) };
      }
      return;
    case "any":
    case "coverage": {
      const seats = question.seats.map(({ seat }) => seat);
      const counts = await cloud.coverage(seats, listening);
      yield { indices: atLeast(counts, 1), counts };
      return;
    }
    case "rows": {
      const seats = question.seats.map(({ seat }) => seat);
      const rows = await cloud.seenBy(seats, listening);
      const counts = rows.offsets.subarray(1).map((end, i) => end - rows.offsets[i]!);
      yield { indices: atLeast(counts, 1), rows, note: rows.note };
      return;
    }
    case "colors": {
      const { seats, merge, weights } = question;
      const images = await Promise.all(seats.map(({ image }) => readImage(question.images, image)));
      const cameras = seats.map(({ seat }) => seat);
      const colors = await transfer(cloud, cameras, images, { ...listening, merge, weights });
      yield { indices: atLeast(colors.seen, 1), colors, note: colors.note };
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
