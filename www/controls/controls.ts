/** Resolves after the present state of the page has been drawn. Use it for work that is not urgent. */
export function nextFrame(): Promise<unknown> {
  return new Promise((resolve) => requestAnimationFrame(resolve));
}

/** An element of index.html. */
export function byId(id: string): HTMLElement;
export function byId<T extends HTMLElement>(id: string, type: new () => T): T;
export function byId(id: string, type = HTMLElement): HTMLElement {
  const element = document.getElementById(id);
  if (!(element instanceof type)) throw new Error(`index.html has no ${type.name} with the id ${id}`);
  return element;
}

/** A share of the way that begins and ends slowly, after a share of the time. */
export function eased(share: number): number {
  return share * share * (3 - 2 * share);
}

/** Whether the user wants less motion. */
export function isCalm(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** Every name begins with this, because other pages of the same site store things, too. */
const OWN = "hidden-point-removal: ";

/** Stores something on this device. A browser may refuse it. */
export function remember(name: string, value: string): void {
  try {
    localStorage.setItem(OWN + name, value);
  } catch {
    // The next visit begins as the first one.
  }
}

/** A row of radio buttons. One of them is chosen. */
export class Segmented<Value extends string = string> {
  readonly #inputs: HTMLInputElement[];

  /** `labels`: the words of each value. */
  constructor(id: string, labels: Readonly<Record<string, string>>, onChange: (value: Value) => void) {
    this.#inputs = Object.entries(labels).map(([value, words]) => {
      const input = Object.assign(document.createElement("input"), { type: "radio", name: id, value });
      input.addEventListener("change", () => onChange(value as Value));
      const label = document.createElement("label");
      label.append(input, words);
      byId(id).append(label);
      return input;
    });
  }

  get value(): Value | null {
    return (this.#inputs.find((input) => input.checked)?.value as Value | undefined) ?? null;
  }

  /** If the value has no button, no button is chosen. */
  set value(value: Value | null) {
    for (const input of this.#inputs) input.checked = input.value === value;
  }
}

/** The track of a slider, and the words beside it for a place on it. */
export interface Track {
  least: number;
  most: number;
  step: number;
  text: (at: number) => string;
}

/** A range input. Its value is shown beside its label, in the output `id`-value. */
export class Slider {
  readonly #input: HTMLInputElement;
  readonly #output: HTMLOutputElement;
  readonly #text: (value: number) => string;

  constructor(id: string, { text, least, most, step }: Track, onInput: (value: number) => void) {
    this.#input = byId(id, HTMLInputElement);
    Object.assign(this.#input, { min: least, max: most, step });
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
