import { byId } from "../controls/controls.ts";
import type { Spot } from "./find.ts";
import type { Mark } from "./marks.ts";
import type { Bench, Tool } from "./tool.ts";

/** Texts on points. A text is there as long as its point is visible. */
export class Label implements Tool {
  readonly name = "label";
  readonly uses = "clicks";
  readonly #bench: Bench;
  readonly #form = byId("label-form", HTMLFormElement);
  readonly #input = byId("label-text", HTMLInputElement);
  readonly #output = byId("label-result");
  readonly #list = byId("label-list");
  #begun: { index: number; mark: Mark } | null = null;
  #labels: { index: number; text: string; mark: Mark }[] = [];

  constructor(bench: Bench) {
    this.#bench = bench;
    this.#form.addEventListener("submit", (event) => {
      event.preventDefault();
      const text = this.#input.value.trim();
      if (this.#begun && text !== "") this.add(this.#begun.index, text);
      this.#drop();
      byId("view").focus();
    });
  }

  click(spot: Spot): void {
    const index = this.#bench.pointAt(spot);
    this.#drop();
    if (typeof index === "string") {
      this.#output.textContent = index;
      return;
    }
    this.#begun = { index, mark: this.#bench.marks.ring(index) };
    this.#output.textContent = `Text for point ${index}`;
    this.#form.hidden = false;
    this.#input.focus();
  }

  cancel(): boolean {
    const begun = this.#begun !== null;
    this.#drop();
    return begun;
  }

  leave(): void {
    this.#drop();
  }

  clear(): void {
    this.#drop();
    for (const { mark } of this.#labels.splice(0)) mark.remove();
    this.#list.replaceChildren();
    this.#bench.changed();
  }

  #drop(): void {
    this.#begun?.mark.remove();
    this.#begun = null;
    this.#input.value = "";
    this.#form.hidden = true;
    this.#output.textContent = "Click the point to be labeled.";
  }

  /** The labels, in the order in which they were added. */
  get texts(): readonly { index: number; text: string }[] {
    return this.#labels;
  }

  /** Puts a text on a point. */
  add(index: number, text: string): void {
    const mark = this.#bench.marks.note(index, text);
    this.#labels.push({ index, text, mark });
    const entry = document.createElement("li");
    const name = document.createElement("span");
    name.textContent = text;
    const remove = document.createElement("button");
    remove.type = "button";
    remove.textContent = "Remove";
    remove.ariaLabel = `Remove the label ${text}`;
    remove.addEventListener("click", () => {
      mark.remove();
      this.#labels = this.#labels.filter((label) => label.mark !== mark);
      entry.remove();
      this.#bench.changed();
      byId("view").focus();
    });
    entry.append(name, remove);
    this.#list.append(entry);
    this.#bench.changed();
  }
}
