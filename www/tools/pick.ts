import { byId } from "../controls/dom.ts";
import { copy } from "./files.ts";
import { pointAt, type Spot } from "./find.ts";
import type { Mark } from "./marks.ts";
import type { Bench, Tool } from "./tool.ts";

export const NO_POINT = { visible: "No visible point there.", any: "No point there." };

/** Shows the place of a clicked point, in the file's coordinates, and its index. */
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
        this.#copy.textContent = copied ? "Copied" : "The browser forbids it";
      });
    });
  }

  click(spot: Spot): void {
    const { viewer, marks, through } = this.#bench;
    const index = pointAt(viewer, spot, through());
    this.clear();
    if (index === null) {
      this.#output.textContent = through() ? NO_POINT.any : NO_POINT.visible;
      return;
    }
    const place = [0, 1, 2].map((axis) => viewer.scene.positions[3 * index + axis]!);
    this.#output.replaceChildren(
      ...["x", "y", "z"].map((axis, i) => row(axis, String(place[i]))),
      row("index", String(index)),
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

function row(name: string, value: string): HTMLElement {
  const line = document.createElement("span");
  const label = document.createElement("b");
  label.textContent = name;
  line.append(label, ` ${value}`);
  return line;
}
