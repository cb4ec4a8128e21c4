import type { Bench } from "../tool.ts";
import { measured, measuresOf, split, wayBetween } from "../figures.ts";
import type { Mark } from "../marks.ts";
import { row } from "../pick.ts";

/** The area of a polygon through clicked points: of the polygon itself, and of its shadow on the ground. */
export class AreaMeasure {
  readonly mode = "area";
  readonly invitation = "Click the corners.";
  readonly #bench: Bench;
  #corners: number[] = [];
  #marks: Mark[] = [];

  constructor(bench: Bench) {
    this.#bench = bench;
  }

  /** The corners, for the address. `null`: there are fewer than three. */
  get words(): string | null {
    return this.#corners.length < 3 ? null : this.#corners.join();
  }

  /** Takes a corner. Returns what is known then. */
  add(index: number): Node[] {
    this.#corners.push(index);
    this.#draw();
    const { viewer } = this.#bench;
    const measures = measuresOf(viewer.cloud!);
    const { unit } = measures;
    const [first] = this.#corners as [number];
    const at = this.#corners.map((corner) => wayBetween(viewer.scene, first, corner, measures));
    const around = at.reduce((sum, place, i) => sum + distance(place, at.at(i - 1)!), 0);
    const count = row("Corners", String(this.#corners.length));
    if (this.#corners.length < 3) return [count];
    const normal = vectorArea(at);
    const { height } = split(normal, this.#bench.upward());
    return [
      count,
      row("Area", measured(Math.hypot(...normal), unit, 2)),
      row("Horizontal", measured(Math.abs(height), unit, 2)),
      row("Perimeter", measured(around, unit)),
    ];
  }

  clear(): void {
    this.#corners = [];
    this.#draw();
  }

  #draw(): void {
    for (const mark of this.#marks.splice(0)) mark.remove();
    const corners = this.#corners;
    if (corners.length === 1) this.#marks.push(this.#bench.marks.ring(corners[0]!));
    // Two corners have one line, not two.
    for (let i = corners.length === 2 ? 1 : 0; i < corners.length && corners.length > 1; i++) {
      this.#marks.push(this.#bench.marks.line(corners.at(i - 1)!, corners[i]!, ""));
    }
  }
}

function distance(a: readonly number[], b: readonly number[]): number {
  return Math.hypot(...a.map((value, axis) => value - b[axis]!));
}

/** A vector across the polygon. Its length is the area, also if the corners are not quite in one plane. */
function vectorArea(at: readonly (readonly number[])[]): number[] {
  const sum = [0, 0, 0];
  for (const [i, b] of at.entries()) {
    const a = at.at(i - 1)!;
    for (let axis = 0; axis < 3; axis++) {
      const [k, l] = [(axis + 1) % 3, (axis + 2) % 3];
      sum[axis]! += (a[k]! * b[l]! - a[l]! * b[k]!) / 2;
    }
  }
  return sum;
}
