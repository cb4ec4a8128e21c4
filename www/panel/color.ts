import type { Cloud } from "../cloud/cloud.ts";
import type { Store } from "../settings/store.ts";
import { colorChoices, type Legend } from "../view/colors.ts";
import { byId } from "../controls/dom.ts";

export interface ColorControl {
  /** Offers the attributes by which a cloud can be colored. */
  offer: (cloud: Cloud) => void;
  explain: (legend: Legend | null) => void;
}

/** The choice of colors, and a legend that explains them. */
export function bindColor(store: Store): ColorControl {
  const select = byId("color", HTMLSelectElement);
  const legend = byId("legend");
  select.addEventListener("change", () => store.change({ color: select.value }));
  store.follow(({ color }) => (select.value = color));
  return {
    offer: (cloud) => {
      select.replaceChildren(...colorChoices(cloud).map(({ value, label }) => new Option(label, value)));
      select.value = store.current.color;
    },
    explain: (next) => {
      legend.hidden = next === null;
      legend.replaceChildren(...(next === null ? [] : next.kind === "ramp" ? rampParts(next) : categoryParts(next)));
    },
  };
}

function rampParts({ low, high, colors }: Extract<Legend, { kind: "ramp" }>): Node[] {
  const bar = element("span", "ramp");
  bar.style.background = `linear-gradient(90deg, ${colors.join(", ")})`;
  const digits = Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(high - low || 1))));
  const number = new Intl.NumberFormat("en-US", { maximumFractionDigits: digits });
  return [bar, element("span", "low", number.format(low)), element("span", "high", number.format(high))];
}

function categoryParts({ entries }: Extract<Legend, { kind: "categories" }>): Node[] {
  const list = element("ul", "");
  for (const { label, color, count } of entries) {
    const swatch = element("span", "swatch");
    swatch.style.background = color;
    const item = element("li", "");
    item.append(swatch, label, element("span", "count", count.toLocaleString("en-US")));
    list.append(item);
  }
  return [list];
}

function element(tag: string, name: string, text = ""): HTMLElement {
  const made = document.createElement(tag);
  if (name) made.className = name;
  made.textContent = text;
  return made;
}
