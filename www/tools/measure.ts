import { byId } from "../controls/dom.ts";
import { pointAt, type Spot } from "./find.ts";
import type { Mark } from "./marks.ts";
import { NO_POINT } from "./pick.ts";
import type { Bench, Tool } from "./tool.ts";

/** Shows the distance between two clicked points, in the file's units. Many distances can be shown at once. */
export class Measure implements Tool {
  readonly name = "measure";
  readonly uses = "clicks";
  readonly #bench: Bench;
  readonly #output = byId("measure-result");
  readonly #remove = byId("measure-clear", HTMLButtonElement);
  #from: { index: number; mark: Mark } | null = null;
  #lines: Mark[] = [];

  constructor(bench: Bench) {
    this.#bench = bench;
    this.#remove.addEventListener("click", () => {
      this.clear();
      byId("view").focus();
    });
  }

  click(spot: Spot): void {
    const { viewer, marks, through } = this.#bench;
    const index = pointAt(viewer, spot, through());
    if (index === null) {
      this.#output.textContent = through() ? NO_POINT.any : NO_POINT.visible;
    } else if (!this.#from) {
      this.#from = { index, mark: marks.ring(index) };
      this.#output.textContent = "Now the second point.";
    } else {
      const distance = this.#distance(this.#from.index, index);
      const text = distanceText(distance);
      this.#lines.push(marks.line(this.#from.index, index, text));
      this.#drop();
      this.#output.textContent = `Distance ${text}`;
      this.#output.dataset["distance"] = String(distance);
      this.#remove.hidden = false;
    }
  }

  cancel(): boolean {
    const begun = this.#from !== null;
    this.#drop();
    if (begun) this.#output.textContent = "Click two points.";
    return begun;
  }

  leave(): void {
    this.cancel();
  }

  clear(): void {
    this.#drop();
    for (const line of this.#lines.splice(0)) line.remove();
    this.#output.textContent = "Click two points.";
    delete this.#output.dataset["distance"];
    this.#remove.hidden = true;
  }

  #drop(): void {
    this.#from?.mark.remove();
    this.#from = null;
  }

  #distance(a: number, b: number): number {
    const { positions } = this.#bench.viewer.scene;
    return Math.hypot(...[0, 1, 2].map((axis) => positions[3 * a + axis]! - positions[3 * b + axis]!));
  }
}

/** The distance with six digits: no scanner is more precise. */
function distanceText(distance: number): string {
  return String(Number(distance.toPrecision(6)));
}
