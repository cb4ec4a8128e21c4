import { byId } from "../controls/controls.ts";
import { pointsWithin } from "./find.ts";
import { onDrag } from "./pointer.ts";
import type { Bench, Tool } from "./tool.ts";

type Place = { x: number; y: number };

const number = new Intl.NumberFormat("en-US");

/** Selects the visible points within a line that is drawn over the picture. Shift adds. */
export class Select implements Tool {
  readonly name = "select";
  readonly uses = "drags";
  readonly #bench: Bench;
  readonly #output = byId("select-result");
  readonly #remove = byId("select-clear", HTMLButtonElement);
  readonly #outline = document.createElementNS("http://www.w3.org/2000/svg", "polygon");
  readonly #drags: { cancel: () => boolean };
  #chosen: Uint32Array = new Uint32Array();

  constructor(bench: Bench, canvas: HTMLElement, active: () => boolean) {
    this.#bench = bench;
    this.#outline.classList.add("outline");
    bench.marks.svg.append(this.#outline);
    this.#drags = onDrag(canvas, () => active() && bench.viewer.cloud !== null, {
      drag: (path) => this.#draw(path),
      end: (path, event) => {
        bench.whenFinal(() => this.#end(path, event.shiftKey));
      },
    });
    this.#remove.addEventListener("click", () => {
      this.#choose(new Uint32Array());
      byId("view").focus();
    });
  }

  /** The indices of the selected points, ascending. */
  get indices(): Uint32Array {
    return this.#chosen;
  }

  leave(): void {
    this.#drags.cancel();
    this.#draw([]);
  }

  cancel(): boolean {
    this.#draw([]);
    if (this.#drags.cancel()) return true;
    const some = this.#chosen.length > 0;
    this.#choose(new Uint32Array());
    return some;
  }

  clear(): void {
    this.leave();
    this.#choose(new Uint32Array());
  }

  #end(path: Place[], adds: boolean): void {
    this.#draw([]);
    const through = this.#bench.through();
    const found = path.length > 1 ? pointsWithin(this.#bench.viewer, path, through) : new Uint32Array();
    this.#choose(adds ? Uint32Array.from(new Set([...this.#chosen, ...found])).sort() : found);
    if (path.length > 1 && found.length === 0) {
      this.#output.textContent = through ? "No point inside." : "No visible point inside.";
    }
  }

  #choose(indices: Uint32Array): void {
    this.#chosen = indices;
    this.#bench.viewer.setChosen(indices);
    const { length } = indices;
    this.#output.textContent =
      length === 0
        ? "Draw around points. Hidden points are left out."
        : `${number.format(length)} ${length === 1 ? "point" : "points"} selected. Export saves them.`;
    this.#output.dataset["count"] = String(length);
    this.#remove.hidden = length === 0;
  }

  #draw(line: Place[]): void {
    this.#outline.setAttribute("points", line.map(({ x, y }) => `${x},${y}`).join(" "));
  }
}
