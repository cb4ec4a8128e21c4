import { byId } from "../controls/dom.ts";
import { Segmented } from "../controls/segmented.ts";
import { pointsWithin } from "./find.ts";
import { onDrag } from "./pointer.ts";
import type { Bench, Tool } from "./tool.ts";

type Place = { x: number; y: number };

const number = new Intl.NumberFormat("en-US");

/** Selects the points within a line or a box that is drawn over the picture. Shift adds, Alt takes away. */
export class Select implements Tool {
  readonly name = "select";
  readonly uses = "drags";
  /** Called when the tool is opened. */
  onOpen: () => void = () => undefined;
  /** Called when other points are selected, or in another way. */
  onChange: () => void = () => undefined;
  readonly #bench: Bench;
  readonly #output = byId("select-result");
  readonly #remove = byId("select-clear", HTMLButtonElement);
  readonly #outline = document.createElementNS("http://www.w3.org/2000/svg", "polygon");
  readonly #shape = new Segmented<"lasso" | "box" | "range">("select-shape", () => {
    this.onChange();
  });
  readonly #drags: { cancel: () => boolean };
  #chosen: Uint32Array = new Uint32Array();

  constructor(bench: Bench, canvas: HTMLElement, active: () => boolean) {
    this.#bench = bench;
    this.#outline.classList.add("outline");
    bench.marks.svg.append(this.#outline);
    this.#drags = onDrag(canvas, () => active() && !this.isRange && bench.viewer.cloud !== null, {
      drag: (path) => {
        this.#draw(this.#line(path));
      },
      end: (path, event) => {
        bench.whenFinal(() => {
          this.#draw([]);
          const found =
            path.length > 1 ? pointsWithin(bench.viewer, this.#line(path), bench.through()) : new Uint32Array();
          this.choose(
            event.shiftKey ? joined(this.#chosen, found) : event.altKey ? without(this.#chosen, found) : found,
          );
          if (path.length > 1 && found.length === 0) {
            this.#output.textContent = bench.through() ? "No point inside." : "No visible point inside.";
          }
        });
      },
    });
    this.#remove.addEventListener("click", () => {
      this.choose(new Uint32Array());
      byId("view").focus();
    });
    byId("select-all").addEventListener("click", () => {
      bench.whenFinal(() => {
        const { width, height } = bench.viewer.stage.size;
        this.choose(pointsWithin(bench.viewer, box({ x: 0, y: 0 }, { x: width + 1, y: height + 1 }), bench.through()));
      });
    });
  }

  /** The indices of the selected points, ascending. */
  get indices(): Uint32Array {
    return this.#chosen;
  }

  /** Whether points are selected by their coordinates, not in the picture. */
  get isRange(): boolean {
    return this.#shape.value === "range";
  }

  open(): void {
    this.onOpen();
  }

  leave(): void {
    this.#drags.cancel();
    this.#draw([]);
  }

  cancel(): boolean {
    this.#draw([]);
    if (this.#drags.cancel()) return true;
    const some = this.#chosen.length > 0;
    this.choose(new Uint32Array());
    return some;
  }

  clear(): void {
    this.leave();
    this.choose(new Uint32Array());
  }

  /** Selects these points, ascending, and no others. */
  choose(indices: Uint32Array): void {
    this.#chosen = indices;
    this.#bench.viewer.setChosen(indices);
    const { length } = indices;
    this.#output.textContent =
      length === 0 ? "Draw around points." : `${number.format(length)} ${length === 1 ? "point" : "points"} selected`;
    this.#output.dataset["count"] = String(length);
    this.#remove.hidden = length === 0;
    this.onChange();
    this.#bench.changed();
  }

  #line(path: Place[]): Place[] {
    return this.#shape.value === "lasso" ? path : box(path[0]!, path.at(-1)!);
  }

  #draw(line: Place[]): void {
    this.#outline.setAttribute("points", line.map(({ x, y }) => `${x},${y}`).join(" "));
  }
}

function box(a: Place, b: Place): Place[] {
  return [a, { x: b.x, y: a.y }, b, { x: a.x, y: b.y }];
}

/** Joins two lists of indices. Both lists and the result are ascending. */
function joined(a: Uint32Array, b: Uint32Array): Uint32Array {
  const all = new Uint32Array(a.length + b.length);
  let count = 0;
  for (let i = 0, j = 0; i < a.length || j < b.length; count++) {
    const next = Math.min(a[i] ?? Infinity, b[j] ?? Infinity);
    if (a[i] === next) i++;
    if (b[j] === next) j++;
    all[count] = next;
  }
  return all.slice(0, count);
}

function without(a: Uint32Array, b: Uint32Array): Uint32Array {
  let j = 0;
  return a.filter((index) => {
    while (j < b.length && b[j]! < index) j++;
    return b[j] !== index;
  });
}
