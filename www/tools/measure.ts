import { byId } from "../controls/controls.ts";
import type { Spot } from "./find.ts";
import { measured, measuresOf, split, wayBetween } from "./make.ts";
import type { Mark } from "./marks.ts";
import { row } from "./pick.ts";
import type { Bench, Tool } from "./tool.ts";

/**
 * Shows the distance between two clicked points, its horizontal part and the difference of their heights, in the file's
 * units. Many distances can be shown at once.
 */
export class Measure implements Tool {
  readonly name = "measure";
  readonly uses = "clicks";
  readonly #bench: Bench;
  readonly #output = byId("measure-result");
  readonly #undo = byId("measure-undo", HTMLButtonElement);
  readonly #remove = byId("measure-clear", HTMLButtonElement);
  #from: { index: number; mark: Mark } | null = null;
  #lines: { ends: readonly [number, number]; mark: Mark }[] = [];

  constructor(bench: Bench) {
    this.#bench = bench;
    this.#undo.addEventListener("click", () => {
      this.#lines.pop()?.mark.remove();
      const last = this.#lines.at(-1);
      if (last) this.#say(...last.ends);
      else this.clear();
      this.#bench.changed();
    });
    this.#remove.addEventListener("click", () => {
      this.clear();
      byId("view").focus();
    });
  }

  click(spot: Spot): void {
    const index = this.#bench.pointAt(spot);
    if (typeof index === "string") {
      this.#output.textContent = index;
    } else if (!this.#from) {
      this.#from = { index, mark: this.#bench.marks.ring(index) };
      this.#output.textContent = "Now the second point.";
    } else {
      const from = this.#from.index;
      this.#drop();
      this.measure(from, index);
    }
  }

  /** The pairs of points whose distances are shown. */
  get pairs(): readonly (readonly [number, number])[] {
    return this.#lines.map(({ ends }) => ends);
  }

  /** The last distance. `null`: there is none. */
  get distance(): number | null {
    const { distance } = this.#output.dataset;
    return distance === undefined ? null : Number(distance);
  }

  /** Shows the distance between two points. */
  measure(from: number, to: number): void {
    const mark = this.#bench.marks.line(from, to, this.#say(from, to));
    this.#lines.push({ ends: [from, to], mark });
    this.#undo.hidden = this.#remove.hidden = false;
    this.#bench.changed();
  }

  /** Shows a distance in the card, and returns its text. */
  #say(from: number, to: number): string {
    const { viewer } = this.#bench;
    const measures = measuresOf(viewer.cloud!);
    const { unit } = measures;
    const way = wayBetween(viewer.scene, from, to, measures);
    const distance = Math.hypot(...way);
    const { horizontal, height } = split(way, this.#bench.upward());
    this.#output.replaceChildren(
      row("Distance", measured(distance, unit)),
      row("Horizontal", measured(horizontal, unit)),
      row("Height difference", measured(height, unit)),
    );
    this.#output.dataset["distance"] = String(distance);
    return measured(distance, unit);
  }

  cancel(): boolean {
    const begun = this.#from !== null;
    this.#drop();
    if (begun) this.#invite();
    return begun;
  }

  leave(): void {
    this.cancel();
  }

  clear(): void {
    this.#drop();
    for (const { mark } of this.#lines.splice(0)) mark.remove();
    this.#invite();
    delete this.#output.dataset["distance"];
    this.#undo.hidden = this.#remove.hidden = true;
    this.#bench.changed();
  }

  #invite(): void {
    this.#output.textContent = "Click two points.";
  }

  #drop(): void {
    this.#from?.mark.remove();
    this.#from = null;
  }
}
