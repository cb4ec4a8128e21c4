import type { Box } from "./projection.ts";

interface Place {
  x: number;
  y: number;
}

/** The inside of a closed line in the picture. */
export class Area {
  readonly box: Box;
  /**
   * The parts of the line that pass through each row of pixels, from the top of the box. Each part has four numbers: x
   * and y of its beginning, y of its end, and its step sideways for each pixel down.
   */
  readonly #rows: number[][];

  constructor(line: readonly Place[]) {
    const [xs, ys] = [line.map(({ x }) => x), line.map(({ y }) => y)];
    this.box = { left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys) };
    this.#rows = Array.from({ length: this.#rowOf(this.box.bottom) + 1 }, () => []);
    for (const [i, a] of line.entries()) {
      const b = line.at(i - 1)!;
      const last = this.#rowOf(Math.max(a.y, b.y));
      for (let row = this.#rowOf(Math.min(a.y, b.y)); row <= last; row++) {
        this.#rows[row]!.push(a.x, a.y, b.y, (b.x - a.x) / (b.y - a.y));
      }
    }
  }

  /** Whether a place is inside the line. Works only for places in the box. */
  holds(x: number, y: number): boolean {
    const parts = this.#rows[this.#rowOf(y)];
    if (!parts) return false;
    // A ray to the right crosses the line an odd number of times. It does not meet parts in other rows.
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
