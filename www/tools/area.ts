import type { Box } from "./projection.ts";

interface Place {
  x: number;
  y: number;
}

/** What a closed line in the picture surrounds. */
export class Area {
  readonly box: Box;
  /** The parts of the line that pass through a row of pixels, by row from the box's top: four numbers each, where it begins, at which height it ends, and how far it goes sideways for each pixel down. */
  readonly #rows: number[][];

  constructor(line: readonly Place[]) {
    const [xs, ys] = [line.map(({ x }) => x), line.map(({ y }) => y)];
    this.box = { left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys) };
    this.#rows = Array.from({ length: this.#rowOf(this.box.bottom) + 1 }, () => []);
    for (const [i, a] of line.entries()) {
      const b = line.at(i - 1)!;
      const last = this.#rowOf(Math.max(a.y, b.y));
      for (let row = this.#rowOf(Math.min(a.y, b.y)); row <= last; row++)
        this.#rows[row]!.push(a.x, a.y, b.y, (b.x - a.x) / (b.y - a.y));
    }
  }

  /** Of places in the box. */
  holds(x: number, y: number): boolean {
    const parts = this.#rows[this.#rowOf(y)];
    if (!parts) return false;
    // Odd: a ray to the right leaves the line once more than it enters. Parts in other rows it does not meet.
    let inside = false;
    for (let i = 0; i < parts.length; i += 4) {
      const from = parts[i + 1]!;
      if (from > y !== parts[i + 2]! > y && x < parts[i]! + (y - from) * parts[i + 3]!) inside = !inside;
    }
    return inside;
  }

  #rowOf(y: number): number {
    return Math.floor(y - this.box.top);
  }
}
