import type { LoadedCloud } from "../cloud/cloud.ts";
import { partOf } from "../cloud/part.ts";
import { checkedCloud } from "./limits.ts";
import { merged, type Named } from "./merge.ts";
import { LoadProblem } from "./problem.ts";
import type { Loading } from "./loaded.ts";
import { readCloud } from "./read.ts";

const number = new Intl.NumberFormat("en-US");

/** Reads several files into one cloud. A file that cannot be read is named in a note, and the others are kept. */
export async function readSeveral(
  files: readonly File[],
  { limit, onProgress }: Omit<Loading, "name" | "blob">,
): Promise<LoadedCloud> {
  const whole = files.reduce((sum, { size }) => sum + size, 0);
  const problems: string[] = [];
  let parts: Named[] = [];
  let done = 0;
  // Of all points together, every so many-th is kept.
  let step = 1;
  for (const file of files) {
    const { name } = file;
    const reading: Loading = {
      name,
      blob: file,
      limit,
      onProgress: (fraction) => onProgress?.((done + fraction * file.size) / Math.max(1, whole)),
    };
    try {
      if (file.size === 0) throw new LoadProblem(`${name} is empty.`);
      const cloud = checkedCloud(name, await readCloud(reading), false);
      parts.push({ name, cloud: everyNth(cloud, step) });
    } catch (error) {
      if (!(error instanceof LoadProblem)) throw error;
      problems.push(error.message);
    }
    while (pointsOf(parts) > limit) {
      step *= 2;
      parts = parts.map((part) => ({ ...part, cloud: everyNth(part.cloud, 2) }));
    }
    done += file.size;
  }
  if (parts.length === 0) throw new LoadProblem(problems.join(" "));
  const cloud = merged(parts);
  const thinned = step > 1 ? [`Of all points of these files, one in ${number.format(step)} is shown.`] : [];
  return { ...cloud, notes: [...problems, ...thinned, ...(cloud.notes ?? [])] };
}

function pointsOf(parts: readonly Named[]): number {
  return parts.reduce((sum, { cloud }) => sum + cloud.positions.length / 3, 0);
}

function everyNth(cloud: LoadedCloud, step: number): LoadedCloud {
  if (step === 1) return cloud;
  const count = Math.ceil(cloud.positions.length / 3 / step);
  return partOf(
    cloud,
    Uint32Array.from({ length: count }, (_, i) => i * step),
  );
}
