import { button, make, numberField, tableRow } from "../make.ts";
import type { Station } from "./station.ts";
import type { Viewshed } from "./viewshed.ts";

export interface StationActions {
  here: () => void;
  stop: () => void;
  remove: (number: number) => void;
  clear: () => void;
}

const number = new Intl.NumberFormat("en-US");

/** The controls, the table and the figures of the stations. */
export class StationCard {
  readonly #height = numberField("station-height", "Height above a clicked point");
  readonly #said = make("output", {});
  readonly #body = make("tbody");
  readonly #table = make(
    "table",
    { "aria-label": "Stations", hidden: true },
    make(
      "thead",
      {},
      make("tr", {}, ...["Station", "Sees", "Only it"].map((text) => make("th", { scope: "col" }, text)), make("td")),
    ),
    this.#body,
  );
  readonly #meanings = make("ul", { class: "meanings", "aria-label": "Colors" });
  readonly #unseen = make("p", { class: "note", id: "stations-unseen" });
  readonly #bar = make("progress", { max: "1", "aria-label": "Finding what the stations see" });
  readonly #work: HTMLElement;
  readonly #clear: HTMLButtonElement;
  readonly #actions: StationActions;

  constructor(card: HTMLElement, actions: StationActions) {
    this.#actions = actions;
    this.#work = make("div", { class: "work", hidden: true }, this.#bar, button("Stop", actions.stop));
    this.#clear = button("Remove all", actions.clear, { hidden: true });
    card.replaceChildren(
      this.#said,
      this.#table,
      this.#work,
      this.#meanings,
      this.#unseen,
      this.#height.row,
      make("div", { class: "files" }, button("At the camera", actions.here), this.#clear),
    );
  }

  /** How far a station stands above the point that is clicked. */
  get height(): number {
    const value = this.#height.input.valueAsNumber;
    return Number.isFinite(value) ? value : 0;
  }

  set height(value: number) {
    this.#height.input.value = String(value);
  }

  say(sentence: string): void {
    this.#said.textContent = sentence;
  }

  /** `null`: nothing is under way. */
  progress(fraction: number | null): void {
    this.#work.hidden = fraction === null;
    this.#bar.value = fraction ?? 0;
  }

  /** `found`: `null` as long as it is not known what the stations see. */
  show(stations: readonly Station[], found: Viewshed | null): void {
    this.#table.hidden = this.#clear.hidden = stations.length === 0;
    this.#unseen.hidden = this.#meanings.hidden = found === null;
    this.#body.replaceChildren(
      ...stations.map(({ name }, i) => {
        const row = found?.rows[i];
        const remove = button("", () => this.#actions.remove(i), {
          class: "remove",
          "aria-label": `Remove the station ${name}`,
        });
        const counts = [row?.sees, row?.alone].map((count) => (count === undefined ? "–" : number.format(count)));
        return tableRow(name, ...counts, remove);
      }),
    );
    if (!found) return;
    const total = found.counts.length;
    const share = `${((100 * found.unseen) / total).toFixed(1)}\u00a0%`;
    this.#unseen.textContent = `No station sees ${number.format(found.unseen)} of ${number.format(total)} points (${share}).`;
    this.#unseen.dataset["count"] = String(found.unseen);
  }

  /** Says what the colors of the points mean. Of many colors, only the first two and the last one. */
  explain(meanings: readonly { label: string; color: string }[]): void {
    const some = meanings.filter((_, i) => meanings.length <= 4 || i < 2 || i === meanings.length - 1);
    this.#meanings.replaceChildren(
      ...some.map(({ label, color }) => {
        const swatch = make("i");
        swatch.style.background = color;
        return make("li", {}, swatch, label);
      }),
    );
  }
}
