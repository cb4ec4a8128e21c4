import { OWN_COLORS, type Settings, type Store, type Viewpoint } from "../settings/settings.ts";
import { button, make, measuresOf, numberField, tableRow } from "./make.ts";
import { type Inquiry, type Method, methodOf } from "../view/inquiry.ts";
import { STATION_COLORS } from "../settings/table.ts";
import type { Spot } from "./find.ts";
import type { Mark } from "./marks.ts";
import type { Bench, Tool } from "./tool.ts";

/** The color of points that no station sees: it stands out from all counts, also for the color-blind. */
const NONE = "#f0433a";
/** From few stations to many: each one is lighter than the one before, so that the order is seen without the legend. */
const FEW = [38, 79, 120];
const MANY = [240, 228, 150];

/** A color for each count of stations, from none to the most. */
export function countColors(most: number): Record<number, string> {
  const colors: Record<number, string> = { 0: NONE };
  for (let count = 1; count <= most; count++) {
    const share = most > 1 ? (count - 1) / (most - 1) : 0.5;
    const parts = FEW.map((from, channel) => Math.round(from + share * (MANY[channel]! - from)));
    colors[count] = `#${parts.map((part) => part.toString(16).padStart(2, "0")).join("")}`;
  }
  return colors;
}

/** A place from which a scanner or a camera looks. */
export interface Station {
  name: string;
  at: Viewpoint;
}

/** More stations would make the list too long, and the colors too many to tell apart. */
export const MOST_STATIONS = 50;

/** Longer names are cut. */
export const LONGEST_NAME = 40;

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

/** What the stations see together. */
export interface Viewshed {
  /** How many stations see each point. */
  counts: Uint8Array<ArrayBuffer>;
  /** For each station: how many points it sees, and how many of these no other station sees. */
  rows: { sees: number; alone: number }[];
  /** How many points no station sees. */
  unseen: number;
}

/** A long question: it tells the share that is done, and can be stopped. */
export interface Under {
  signal: AbortSignal;
  onProgress: (fraction: number) => void;
}

/** Finds what each station sees. The answers are kept, so that one more station is one more question. */
export class ViewshedFinder {
  readonly #inquiry: Inquiry;
  /** For each place and method: 1 for each point that is seen from there. */
  readonly #seen = new Map<string, Uint8Array>();

  constructor(inquiry: Inquiry) {
    this.#inquiry = inquiry;
  }

  /** One question after another, so that questions for the picture are answered in between. */
  async find(stations: readonly Station[], settings: Settings, { signal, onProgress }: Under): Promise<Viewshed> {
    const masks: Uint8Array[] = [];
    const used = new Set<string>();
    for (const [i, { at }] of stations.entries()) {
      const method = methodOf(settings);
      const key = JSON.stringify([at, method]);
      used.add(key);
      const mask = this.#seen.get(key) ?? (await this.#ask(at, method, signal));
      this.#seen.set(key, mask);
      masks.push(mask);
      onProgress((i + 1) / stations.length);
    }
    for (const key of this.#seen.keys()) if (!used.has(key)) this.#seen.delete(key);
    return summed(this.#inquiry.cloud.length, masks);
  }

  async #ask(at: Viewpoint, method: Method, signal: AbortSignal): Promise<Uint8Array> {
    const options = this.#inquiry.options(method);
    return Uint8Array.from(await this.#inquiry.cloud.coverage([at], { ...options, signal }));
  }
}

function summed(length: number, masks: readonly Uint8Array[]): Viewshed {
  const counts = new Uint8Array(length);
  for (const mask of masks) for (let i = 0; i < length; i++) counts[i]! += mask[i]!;
  const rows = masks.map((mask) => {
    let [sees, alone] = [0, 0];
    for (let i = 0; i < length; i++) {
      if (mask[i] === 0) continue;
      sees++;
      if (counts[i] === 1) alone++;
    }
    return { sees, alone };
  });
  return { counts, rows, unseen: counts.reduce((sum, count) => sum + Number(count === 0), 0) };
}

const INVITATION = "Click where a station stands.";
/** The height of an instrument in meters, and as a share of the cloud's radius if the unit is not known. */
const USUAL_HEIGHT = { meters: 1.7, share: 0.02 };

/** Stations, and which points they see: together, each one, and none. */
export class Stations implements Tool {
  readonly name = "stations";
  readonly uses = "clicks";
  readonly #bench: Bench;
  readonly #store: Store;
  readonly #card: StationCard;
  #stations: Station[] = [];
  #pins: Mark[] = [];
  #finder: ViewshedFinder | null = null;
  #found: Viewshed | null = null;
  #running: AbortController | null = null;

  constructor(bench: Bench, store: Store, card: HTMLElement) {
    this.#bench = bench;
    this.#store = store;
    this.#card = new StationCard(card, {
      here: () => {
        if (bench.viewer.cloud) {
          this.add([{ name: this.#nextName(), at: store.current.freeze ?? bench.viewer.viewpoint }]);
        }
      },
      stop: () => this.#running?.abort(),
      remove: (i) => {
        this.#stations = this.#stations.filter((_, other) => other !== i);
        this.#changed();
      },
      clear: () => {
        this.#stations = [];
        this.#changed();
      },
    });
    store.follow((now, before) => {
      const { viewer } = bench;
      if (!viewer.cloud) return;
      const changed = JSON.stringify(methodOf(now)) !== JSON.stringify(methodOf(before));
      if (changed && this.#stations.length > 0) this.#changed();
    });
    this.#invite();
  }

  /** The stations, in the order in which they were added. */
  get all(): readonly Station[] {
    return this.#stations;
  }

  /** How many points no station sees. `null`: it is not known. */
  get unseen(): number | null {
    return this.#found?.unseen ?? null;
  }

  add(stations: readonly Station[]): void {
    const room = MOST_STATIONS - this.#stations.length;
    this.#stations = [...this.#stations, ...stations.slice(0, room)];
    this.#changed(
      stations.length > room ? `The page takes ${MOST_STATIONS} stations. The others are left out.` : undefined,
    );
  }

  click(spot: Spot): void {
    const index = this.#bench.pointAt(spot);
    if (typeof index === "string") {
      this.#card.say(index);
      return;
    }
    const { positions } = this.#bench.viewer.scene;
    const at = this.#bench.upward().map((part, axis) => positions[3 * index + axis]! + part * this.#card.height);
    this.add([{ name: this.#nextName(), at: at as Viewpoint }]);
  }

  cancel(): boolean {
    const runs = this.#running !== null;
    this.#running?.abort();
    return runs;
  }

  clear(): void {
    this.#running?.abort();
    this.#stations = [];
    this.#finder = null;
    this.#show(null);
    this.#invite();
  }

  begin(): void {
    if (this.#stations.length > 0) this.#changed();
  }

  /** The height of an instrument in the units of the cloud. */
  #invite(): void {
    const { cloud } = this.#bench.viewer;
    this.#card.say(INVITATION);
    if (!cloud) return;
    const { unit } = measuresOf(cloud);
    const height = unit ? USUAL_HEIGHT.meters / unit.meters : USUAL_HEIGHT.share * cloud.radius;
    this.#card.height = Number(height.toPrecision(2));
  }

  open(): void {
    if (this.#stations.length === 0) this.#invite();
  }

  #nextName(): string {
    const names = new Set(this.#stations.map(({ name }) => name));
    let i = this.#stations.length + 1;
    while (names.has(`S${i}`)) i++;
    return `S${i}`;
  }

  /** Asks again, since there are other stations. */
  #changed(note?: string): void {
    this.#show(null);
    this.#bench.changed();
    if (this.#stations.length === 0) {
      this.#running?.abort();
      this.#card.say(INVITATION);
      return;
    }
    void this.#run(async (under) => {
      this.#card.say("Finding what the stations see.");
      this.#show(await this.#finderNow.find(this.#stations, this.#store.current, under));
      this.#card.say(note ?? "");
    });
  }

  get #finderNow(): ViewshedFinder {
    return (this.#finder ??= new ViewshedFinder(this.#bench.viewer.scene.inquiry));
  }

  /** Runs one long question. It replaces the one that is under way. `undefined`: it was stopped or has failed. */
  async #run<T>(ask: (under: Under) => Promise<T>): Promise<T | undefined> {
    this.#running?.abort();
    const running = (this.#running = new AbortController());
    const { signal } = running;
    const onProgress = (fraction: number) => {
      if (!signal.aborted) this.#card.progress(fraction);
    };
    onProgress(0);
    try {
      return await ask({ signal, onProgress });
    } catch (error) {
      if (running === this.#running) {
        this.#card.say(signal.aborted ? "Stopped." : `The answer could not be found: ${(error as Error).message}.`);
      }
      return undefined;
    } finally {
      if (running === this.#running) {
        this.#running = null;
        this.#card.progress(null);
      }
    }
  }

  #show(found: Viewshed | null): void {
    const { viewer, marks } = this.#bench;
    this.#found = found;
    for (const pin of this.#pins.splice(0)) pin.remove();
    this.#pins = this.#stations.map(({ name, at }) => marks.pin(at, name));
    this.#card.show(this.#stations, found);
    if (found) {
      const { labels, colors, ...attribute } = colorsOf(found);
      viewer.setAttribute(STATION_COLORS, { ...attribute, labels: Object.fromEntries(labels.entries()), colors });
      this.#card.explain(labels.map((label, count) => ({ label, color: colors[count]! })));
      this.#store.change({ color: STATION_COLORS });
    } else if (this.#stations.length === 0 && this.#store.current.color === STATION_COLORS) {
      this.#store.change({ color: OWN_COLORS });
      viewer.setAttribute(STATION_COLORS, null);
    }
  }
}

/** How many stations see each point: the values, and the label and the color of each count. */
function colorsOf({ counts, rows }: Viewshed) {
  const most = counts.reduce((a, b) => Math.max(a, b), 0);
  const labels = Array.from({ length: most + 1 }, (_, count) =>
    count === 0 ? "seen by none" : `seen by ${count}${count === rows.length && count > 1 ? " (all)" : ""}`,
  );
  return { name: STATION_COLORS, kind: "category" as const, values: counts, labels, colors: countColors(most) };
}
