import type { LoadedCloud } from "../cloud/cloud.ts";
import { partOf } from "../cloud/prepare.ts";
import { LoadProblem } from "./protocol.ts";

/** Beyond this, squared distances no longer fit into the f32 arithmetic of the graphics card. */
const MAX_EXTENT = 1e18;

const number = new Intl.NumberFormat("en-US");

/**
 * Refuses an empty cloud, and one that is too wide to draw. Points without a position are refused. They are dropped if
 * that is asked for, or if the points are a grid: a depth camera has no point where it sees nothing.
 */
export function checkedCloud(name: string, cloud: LoadedCloud, skipNonFinite: boolean): LoadedCloud {
  const total = cloud.positions.length / 3;
  if (total === 0) throw new LoadProblem(`${name} holds no points.`);

  const bad = countNonFinite(cloud.positions);
  if (bad === total) throw new LoadProblem(`${name} holds no points: none of its coordinates are numbers.`);
  if (bad > 0 && !skipNonFinite && !cloud.isGrid) {
    throw new LoadProblem(
      `${name} has ${number.format(bad)} of ${number.format(total)} points without a position (NaN or infinite).`,
      { words: "without them", with: { skipNonFinite: true } },
    );
  }
  const finite = bad > 0 ? withoutNonFinite(cloud, total - bad) : cloud;
  if (finite.positions.some((value) => Math.abs(value) > MAX_EXTENT)) {
    throw new LoadProblem(`${name} has coordinates above 10¹⁸, too far out to be drawn.`);
  }
  const notes = [...(finite.notes ?? [])];
  if (bad > 0 && !skipNonFinite) {
    notes.unshift(
      `${number.format(bad)} of the ${number.format(total)} places in its rows and columns have no point (NaN) and are left out.`,
    );
  }
  return { ...finite, notes, positions: narrowed(finite.positions) };
}

function isFiniteAt(positions: LoadedCloud["positions"], i: number): boolean {
  return (
    Number.isFinite(positions[3 * i]) && Number.isFinite(positions[3 * i + 1]) && Number.isFinite(positions[3 * i + 2])
  );
}

function countNonFinite(positions: LoadedCloud["positions"]): number {
  let bad = 0;
  for (let i = 0; i < positions.length / 3; i++) if (!isFiniteAt(positions, i)) bad++;
  return bad;
}

function withoutNonFinite(cloud: LoadedCloud, count: number): LoadedCloud {
  const kept = new Uint32Array(count);
  for (let i = 0, at = 0; at < count; i++) if (isFiniteAt(cloud.positions, i)) kept[at++] = i;
  return partOf(cloud, kept);
}

/** Halves the memory if f32 holds every coordinate exactly. */
function narrowed(positions: LoadedCloud["positions"]): LoadedCloud["positions"] {
  if (positions instanceof Float32Array) return positions;
  return positions.every((value) => Math.fround(value) === value) ? Float32Array.from(positions) : positions;
}
