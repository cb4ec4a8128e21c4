import { byId } from "./dom.ts";
import { Slider } from "./slider.ts";

/** The exponent: automatic until the slider is moved, automatic again at the press of its button. */
export class ExponentControl {
  /** `null`: automatic. */
  private value: number | null;
  private readonly slider: Slider;
  private readonly button: HTMLButtonElement;
  private readonly onChange: (value: number | null) => void;

  constructor(initial: number | null, onChange: (value: number | null) => void) {
    this.value = initial;
    this.onChange = onChange;
    this.button = byId("exponent-auto", HTMLButtonElement);
    this.slider = new Slider("exponent", (value) => value.toFixed(2), (value) => {
      this.set(value);
    });
    this.button.addEventListener("click", () => {
      this.set(null);
    });
    if (initial === null) this.slider.clear();
    else this.slider.value = initial;
    this.set(initial);
  }

  /** The exponent of an answer: in automatic mode the slider follows it. */
  follow(exponent: number): void {
    if (this.value === null) this.slider.value = exponent;
  }

  private set(value: number | null): void {
    this.value = value;
    this.button.setAttribute("aria-pressed", String(value === null));
    this.onChange(value);
  }
}
