import { byId } from "./dom.ts";

/** A row of radio buttons. One of them is chosen. */
export class Segmented<Value extends string = string> {
  readonly #inputs: HTMLInputElement[];

  constructor(id: string, onChange: (value: Value) => void) {
    this.#inputs = [...byId(id).querySelectorAll("input")];
    for (const input of this.#inputs) input.addEventListener("change", () => onChange(input.value as Value));
  }

  get value(): Value | null {
    return (this.#inputs.find((input) => input.checked)?.value as Value | undefined) ?? null;
  }

  /** If the value has no button, no button is chosen. */
  set value(value: Value | null) {
    for (const input of this.#inputs) input.checked = input.value === value;
  }
}
