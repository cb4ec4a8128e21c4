import type { LoadedCloud } from "../cloud.ts";
import { LoadProblem } from "./problem.ts";

/** Three's loaders build plain arrays and, for text, one string: above these sizes a tab runs out of memory or of string. */
export const MAX_POINTS = 10_000_000;
export const MAX_BYTES = 500_000_000;

/** Beyond this, squared distances no longer fit the f32 arithmetic of the graphics card. */
const MAX_EXTENT = 1e18;

const number = new Intl.NumberFormat("en-US");

export function checkByteLength(name: string, bytes: number): void {
  if (bytes === 0) throw new LoadProblem(`${name} is empty.`);
  if (bytes > MAX_BYTES) {
    throw new LoadProblem(
      `${name} is too large: ${number.format(Math.round(bytes / 1e6))} MB, and this page opens files up to ${MAX_BYTES / 1e6} MB.`,
    );
  }
}

export function checkPointCount(name: string, points: number): void {
  if (points > MAX_POINTS) {
    throw new LoadProblem(
      `${name} is too large: ${number.format(points)} points, and this page opens clouds up to ${number.format(MAX_POINTS)}.`,
    );
  }
}

/** Refuses an empty cloud, one with points that are nowhere (or drops those), and one that is too wide to draw. */
export function checkedCloud(name: string, cloud: LoadedCloud, skipNonFinite: boolean): LoadedCloud {
  const total = cloud.positions.length / 3;
  if (total === 0) throw new LoadProblem(`${name} holds no points.`);
  checkPointCount(name, total);

  const bad = countNonFinite(cloud.positions);
  if (bad === total) throw new LoadProblem(`${name} holds no points: none of its coordinates are numbers.`);
  if (bad > 0 && !skipNonFinite) {
    throw new LoadProblem(
      `${name} has ${number.format(bad)} of ${number.format(total)} points without a position (NaN or infinite).`,
      bad,
    );
  }
  const finite = bad > 0 ? withoutNonFinite(cloud, total - bad) : cloud;
  if (finite.positions.some((value) => Math.abs(value) > MAX_EXTENT)) {
    throw new LoadProblem(`${name} has coordinates above 10¹⁸, too far out to be drawn.`);
  }
  return { ...cloud, positions: narrowed(finite.positions), colors: finite.colors };
}

function isFiniteAt(positions: LoadedCloud["positions"], i: number): boolean {
  return Number.isFinite(positions[3 * i]) && Number.isFinite(positions[3 * i + 1]) && Number.isFinite(positions[3 * i + 2]);
}

function countNonFinite(positions: LoadedCloud["positions"]): number {
  let bad = 0;
  for (let i = 0; i < positions.length / 3; i++) if (!isFiniteAt(positions, i)) bad++;
  return bad;
}

function withoutNonFinite({ positions, colors }: LoadedCloud, count: number): LoadedCloud {
  const kept = new Float64Array(3 * count);
  const keptColors = colors && new Uint8Array(3 * count);
  let at = 0;
  for (let i = 0; i < positions.length / 3; i++) {
    if (!isFiniteAt(positions, i)) continue;
    kept.set(positions.subarray(3 * i, 3 * i + 3), at);
    keptColors?.set(colors!.subarray(3 * i, 3 * i + 3), at);
    at += 3;
  }
  return { positions: kept, colors: keptColors };
}

/** Half the memory where f32 holds every coordinate exactly. */
function narrowed(positions: LoadedCloud["positions"]): LoadedCloud["positions"] {
  if (positions instanceof Float32Array) return positions;
  return positions.every((value) => Math.fround(value) === value) ? Float32Array.from(positions) : positions;
}
