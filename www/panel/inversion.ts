import { byId } from "../controls/dom.ts";
import { Segmented } from "../controls/segmented.ts";
import { Slider } from "../controls/slider.ts";
import { MOST_POWER } from "../settings/limits.ts";
import type { Inversion } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";
import { SETTINGS } from "../settings/table.ts";

/** The library's automatic c, in spacings. */
const AUTOMATIC_C = 0.07;

/**
 * Binds the kind of flip and the parameter of each kind. A parameter is automatic until its slider is moved. The
 * returned function shows the parameter that an answer was found with.
 */
export function bindInversion(store: Store): (resolved: Inversion) => void {
  const kind = new Segmented("inversion", (text) => {
    store.change({ inversion: SETTINGS.inversion.parse(text)! });
  });
  // The sliders have a logarithmic scale: c and γ − 1 go over many powers of ten.
  const scale = new Slider(
    "scale",
    (at) => `${digits(10 ** at)} spacings`,
    (at) => {
      store.change({ inversion: { exponential: Number((10 ** at).toPrecision(4)) } });
    },
  );
  const power = new Slider(
    "power",
    (at) => `1 + ${digits(10 ** at)}`,
    (at) => {
      store.change({ inversion: { power: Math.min(MOST_POWER, 1 + Number((10 ** at).toPrecision(4))) } });
    },
  );
  scale.value = Math.log10(AUTOMATIC_C);
  scale.mark(Math.log10(AUTOMATIC_C));
  const [scaleAuto, powerAuto] = [byId("scale-auto", HTMLButtonElement), byId("power-auto", HTMLButtonElement)];
  scaleAuto.addEventListener("click", () => {
    store.change({ inversion: { exponential: "auto" } });
  });
  powerAuto.addEventListener("click", () => {
    store.change({ inversion: { power: "auto" } });
  });

  store.follow(({ inversion }) => {
    kind.value = SETTINGS.inversion.write(inversion).split(":")[0]!;
    byId("scale-choice").hidden = kind.value !== "exponential";
    byId("power-choice").hidden = kind.value !== "power";
    if (inversion === "spherical") return;
    if ("exponential" in inversion) {
      scaleAuto.setAttribute("aria-pressed", String(inversion.exponential === "auto"));
      scale.value = Math.log10(inversion.exponential === "auto" ? AUTOMATIC_C : inversion.exponential);
    } else {
      powerAuto.setAttribute("aria-pressed", String(inversion.power === "auto"));
      if (inversion.power !== "auto") power.value = Math.log10(inversion.power - 1);
    }
  });
  return (resolved) => {
    const { inversion } = store.current;
    const automatic = inversion !== "spherical" && "power" in inversion && inversion.power === "auto";
    if (automatic && typeof resolved === "object" && "power" in resolved) {
      power.value = Math.log10((resolved.power as number) - 1);
    }
  };
}

function digits(value: number): string {
  return String(Number(value.toPrecision(2)));
}
