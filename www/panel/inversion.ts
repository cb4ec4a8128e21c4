import { AUTOMATIC_C, type Inversion, type Store } from "../settings/settings.ts";
import { byId } from "../controls/dom.ts";
import { Segmented } from "../controls/segmented.ts";
import { Slider } from "../controls/slider.ts";

type Kind = "spherical" | "exponential" | "power";

/** How points are flipped, with each kind's own parameter: automatic until its slider is moved. */
export function bindInversion(store: Store): (resolved: Inversion) => void {
  const kind = new Segmented<Kind>("inversion", (value) => {
    store.change({
      inversion: value === "spherical" ? value : value === "power" ? { power: "auto" } : { exponential: "auto" },
    });
  });
  // Both over many powers of ten: c itself, and what γ has above 1.
  const scale = new Slider(
    "scale",
    (value) => `${digits(10 ** value)} spacings`,
    (value) => {
      store.change({ inversion: { exponential: Number((10 ** value).toPrecision(4)) } });
    },
  );
  const power = new Slider(
    "power",
    (value) => `1 + ${digits(10 ** value)}`,
    (value) => {
      store.change({ inversion: { power: Math.min(16, 1 + Number((10 ** value).toPrecision(4))) } });
    },
  );
  scale.value = scaleAt(AUTOMATIC_C);
  scale.mark(scaleAt(AUTOMATIC_C));
  const [scaleAuto, powerAuto] = [byId("scale-auto", HTMLButtonElement), byId("power-auto", HTMLButtonElement)];
  scaleAuto.addEventListener("click", () => {
    store.change({ inversion: { exponential: "auto" } });
  });
  powerAuto.addEventListener("click", () => {
    store.change({ inversion: { power: "auto" } });
  });

  store.follow(({ inversion }) => {
    kind.value = inversion === "spherical" ? inversion : "power" in inversion ? "power" : "exponential";
    byId("scale-choice").hidden = kind.value !== "exponential";
    byId("power-choice").hidden = kind.value !== "power";
    if (inversion === "spherical") return;
    if ("exponential" in inversion) {
      scaleAuto.setAttribute("aria-pressed", String(inversion.exponential === "auto"));
      scale.value = scaleAt(inversion.exponential === "auto" ? AUTOMATIC_C : inversion.exponential);
    } else {
      powerAuto.setAttribute("aria-pressed", String(inversion.power === "auto"));
      if (inversion.power !== "auto") power.value = Math.log10(inversion.power - 1);
    }
  });
  return (resolved) => {
    const { inversion } = store.current;
    const automatic = inversion !== "spherical" && "power" in inversion && inversion.power === "auto";
    if (automatic && typeof resolved === "object" && "power" in resolved)
      power.value = Math.log10((resolved.power as number) - 1);
  };
}

function scaleAt(spacings: number): number {
  return Math.log10(spacings);
}

function digits(value: number): string {
  return String(Number(value.toPrecision(2)));
}
