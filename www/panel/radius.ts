import type { ViewAnswer } from "../ask/views.ts";
import { byId } from "../controls/dom.ts";
import { Slider } from "../controls/slider.ts";
import { SLIDERS } from "../settings/sliders.ts";
import type { Store } from "../settings/store.ts";

/** The radius of one hull: automatic, until the slider is moved. The returned function shows that of an answer. */
export function bindRadius(store: Store): (answer: ViewAnswer) => void {
  const slider = new Slider("exponent", SLIDERS.exponent.text, (exponent) => store.change({ radius: { exponent } }));
  slider.clear();
  const automatic = byId("radius-auto");
  automatic.addEventListener("click", () => store.change({ radius: { rule: "auto" } }));
  const group = byId("radius-choice", HTMLFieldSetElement);
  store.follow(({ radius, inversion }) => {
    automatic.setAttribute("aria-pressed", String("rule" in radius));
    group.disabled = inversion !== "spherical";
    if ("exponent" in radius) slider.value = radius.exponent;
  });
  return ({ question, visibility }) => {
    const { radius, inversion } = store.current;
    const isFound = question.method.radius !== null && inversion === "spherical";
    if (isFound && !("exponent" in radius)) slider.value = visibility.exponent;
  };
}
