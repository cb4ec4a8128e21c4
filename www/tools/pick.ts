import { byId } from "../controls/controls.ts";
import { coordinatesAt, fieldText, indexInFile } from "./make.ts";
import { copy } from "./export.ts";
import type { Spot } from "./find.ts";
import type { Mark } from "./marks.ts";
import type { Bench, Tool } from "./tool.ts";

/** Shows all that the file says about a clicked point: its place in the file's coordinates, and its attributes. */
export class Pick implements Tool {
  readonly name = "pick";
  readonly uses = "clicks";
  readonly #bench: Bench;
  readonly #output = byId("pick-result");
  readonly #copy = byId("pick-copy", HTMLButtonElement);
  #mark: Mark | null = null;

  constructor(bench: Bench) {
    this.#bench = bench;
    this.#copy.addEventListener("click", () => {
      void copy(this.#output.dataset["place"]!).then((copied) => {
        this.#copy.textContent = copied ? "Copied" : "The browser does not allow it";
      });
    });
  }

  click(spot: Spot): void {
    const { viewer, marks } = this.#bench;
    const index = this.#bench.pointAt(spot);
    this.clear();
    if (typeof index === "string") {
      this.#output.textContent = index;
      return;
    }
    const { scene } = viewer;
    const place = coordinatesAt(scene, index);
    const { colors, fields } = scene.cloud;
    const color =
      colors && !fields.some(({ name }) => name === "red") ? colors.subarray(3 * index, 3 * index + 3) : null;
    this.#output.replaceChildren(
      ...["x", "y", "z"].map((axis, i) => row(axis, place[i]!)),
      row("index", String(indexInFile(scene.cloud, index))),
      ...(color ? [row("color", color.join(" "))] : []),
      // A column that is 0 everywhere says nothing.
      ...fields
        .filter(({ values }) => values.some((value) => value !== 0))
        .map((field) => row(field.name.replaceAll("_", " "), fieldText(field, index))),
    );
    this.#output.dataset["index"] = String(index);
    this.#output.dataset["place"] = place.join(", ");
    this.#copy.hidden = false;
    this.#mark = marks.ring(index);
  }

  cancel(): boolean {
    const picked = this.#mark !== null;
    this.clear();
    return picked;
  }

  leave(): void {
    this.clear();
  }

  clear(): void {
    this.#mark?.remove();
    this.#mark = null;
    this.#output.textContent = "Click a point.";
    delete this.#output.dataset["index"];
    delete this.#output.dataset["place"];
    this.#copy.hidden = true;
    this.#copy.textContent = "Copy";
  }
}

/** A line with a name and a value. */
export function row(name: string, value: string): HTMLElement {
  const line = document.createElement("span");
  const label = document.createElement("b");
  label.textContent = name;
  line.append(label, ` ${value}`);
  return line;
}
