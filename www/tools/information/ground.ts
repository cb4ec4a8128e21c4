/** So many points are looked at. An even share of a larger cloud tells the same density. */
const LOOKED_AT = 500_000;
/** A cell of the ground holds so many of these points. With fewer, chance would leave cells empty. */
const IN_A_CELL = 16;
/** The most cells that are counted. */
const MOST_CELLS = 1 << 24;
const ROUNDS = 4;

/**
 * The number of points for each square unit of the ground that they cover, seen along z. The ground is the cells with a
 * point in them, so a road in a large box counts only the road. `null`: the points cover no ground.
 */
export function groundDensity(positions: ArrayLike<number>): number | null {
  const count = positions.length / 3;
  const step = 3 * Math.ceil(count / LOOKED_AT);
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  let looked = 0;
  for (let at = 0; at < positions.length; at += step, looked++) {
    for (const axis of [0, 1]) {
      low[axis] = Math.min(low[axis]!, positions[at + axis]!);
      high[axis] = Math.max(high[axis]!, positions[at + axis]!);
    }
  }
  const [width, depth] = [high[0]! - low[0]!, high[1]! - low[1]!];
  if (!(width > 0 && depth > 0)) return null;

  let side = Math.sqrt((width * depth * IN_A_CELL) / looked);
  let density: number | null = null;
  for (let round = 0; round < ROUNDS; round++) {
    const [columns, rows] = [Math.ceil(width / side) + 1, Math.ceil(depth / side) + 1];
    if (columns * rows > MOST_CELLS) break;
    const cells = new Uint8Array(columns * rows);
    let taken = 0;
    for (let at = 0; at < positions.length; at += step) {
      const column = Math.floor((positions[at]! - low[0]!) / side);
      const cell = column + columns * Math.floor((positions[at + 1]! - low[1]!) / side);
      taken += 1 - cells[cell]!;
      cells[cell] = 1;
    }
    density = count / (taken * side * side);
    side *= Math.sqrt((IN_A_CELL * taken) / looked);
  }
  return density;
}
