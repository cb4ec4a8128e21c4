import type { Box } from "./projection.ts";

interface Place {
  x: number;
  y: number;
}

/** What a closed line in the picture surrounds. */
export class Area {
  readonly box: Box;
  /** For each row of pixels, from that of the box's top, the parts of the line that pass through it. */
  private readonly rows: [Place, Place][][] = [];

  constructor(line: readonly Place[]) {
    const [xs, ys] = [line.map(({ x }) => x), line.map(({ y }) => y)];
    this.box = { left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys) };
    for (const [i, a] of line.entries()) {
      const b = line.at(i - 1)!;
      const last = this.rowOf(Math.max(a.y, b.y));
      for (let row = this.rowOf(Math.min(a.y, b.y)); row <= last; row++) (this.rows[row] ??= []).push([a, b]);
    }
  }

  holds(x: number, y: number): boolean {
    // Odd: a ray to the right leaves the line once more than it enters. Parts in other rows it does not meet.
    let inside = false;
    for (const [a, b] of this.rows[this.rowOf(y)] ?? []) {
      if (a.y > y !== b.y > y && x < a.x + ((y - a.y) * (b.x - a.x)) / (b.y - a.y)) inside = !inside;
    }
    return inside;
  }

  private rowOf(y: number): number {
    return Math.floor(y - this.box.top);
  }
}
