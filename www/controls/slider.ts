import { byId } from "./dom.ts";

/** A range input. Its value is shown beside its label, in the output `id`-value. */
export class Slider {
  readonly #input: HTMLInputElement;
  readonly #output: HTMLOutputElement;
  readonly #text: (value: number) => string;

  constructor(id: string, text: (value: number) => string, onInput: (value: number) => void) {
    this.#input = byId(id, HTMLInputElement);
    this.#output = byId(`${id}-value`, HTMLOutputElement);
    this.#text = text;
    this.#input.addEventListener("input", () => {
      this.#show(this.value);
      onInput(this.value);
    });
    this.#show(this.value);
  }

  get value(): number {
    return this.#input.valueAsNumber;
  }

  /** The knob stops at the ends of its track. The output shows the real value, even beyond these ends. */
  set value(value: number) {
    this.#input.value = String(value);
    this.#show(value);
  }

  /** Shows no value, because none is known yet. */
  clear(): void {
    this.#output.textContent = "";
  }

  #show(value: number): void {
    this.#output.textContent = this.#text(value);
    this.#input.ariaValueText = this.#output.textContent;
  }
}
