import { isAutomatic } from "../ask/question.ts";
import type { ViewAnswer } from "../ask/views.ts";
import { SLIDERS } from "../settings/sliders.ts";
import type { Store } from "../settings/store.ts";
import { byId } from "../controls/dom.ts";
import { Slider } from "../controls/slider.ts";

type Choice = "auto" | "search" | "opposite" | "hand";

const NOTES: Record<Choice, string> = {
  auto: "",
  search: "Tries 6 hulls when the view rests, and takes the best one.",
  opposite: "Looks from the opposite side, too, when the view rests: about 40 hulls.",
  hand: "Exponent: log₁₀ of radius ÷ farthest distance. The mark is the automatic one.",
};

/** The choice of the radius. Moving the slider chooses it by hand. */
export class RadiusControl {
  readonly #store: Store;
  readonly #slider: Slider;

  constructor(store: Store) {
    this.#store = store;
    this.#slider = new Slider("exponent", SLIDERS.exponent.text, (exponent) => {
      store.change({ radius: { exponent } });
    });
    this.#slider.clear();
    const buttons = [...byId("radius").querySelectorAll("button")];
    for (const button of buttons) {
      button.addEventListener("click", () => {
        const choice = button.value as Choice;
        if (choice !== "hand") store.change({ radius: { rule: choice } });
        else if (choiceOf(store) !== "hand") store.change({ radius: { exponent: this.#slider.value } });
      });
    }
    const group = byId("radius-choice", HTMLFieldSetElement);
    const note = byId("radius-note");
    store.follow(({ radius, inversion }) => {
      const choice = choiceOf(store);
      for (const button of buttons) button.setAttribute("aria-pressed", String(button.value === choice));
      group.disabled = inversion !== "spherical";
      note.textContent = inversion === "spherical" ? NOTES[choice] : "Only the spherical method has a radius.";
      note.hidden = note.textContent === "";
      if ("exponent" in radius) this.#slider.value = radius.exponent;
    });
  }

  /** Shows the exponent of an answer, unless the slider was set by hand. */
  follow({ question, visibility }: ViewAnswer): void {
    const { radius, inversion } = this.#store.current;
    if (isAutomatic(question.method)) this.#slider.mark(visibility.exponent);
    if (question.method.radius !== null && inversion === "spherical" && !("exponent" in radius)) {
      this.#slider.value = visibility.exponent;
    }
  }

  markAutomatic(exponent: number): void {
    this.#slider.mark(exponent);
  }
}

function choiceOf({ current: { radius } }: Store): Choice {
  return "rule" in radius ? radius.rule : "hand";
}
