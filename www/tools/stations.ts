import { OWN_COLORS, type Store, type Viewpoint } from "../settings/settings.ts";
import type { Attribute } from "../cloud/cloud.ts";
import { button, make, measuresOf, numberField } from "./make.ts";
import { methodOf } from "../view/inquiry.ts";
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

const number = new Intl.NumberFormat("en-US");

const INVITATION = "Click where a station stands.";
/** The height of an instrument in meters, and as a share of the cloud's radius if the unit is not known. */
const USUAL_HEIGHT = { meters: 1.7, share: 0.02 };

/** Stations, and which points they see: how many of them see each, and which none sees. */
export class Stations implements Tool {
  readonly name = "stations";
  readonly uses = "clicks";
  readonly #bench: Bench;
  readonly #store: Store;
  readonly #height = numberField("station-height", "Height above a clicked point");
  readonly #said = make("output", {});
  readonly #list = make("ul", { class: "list", "aria-label": "Stations" });
  readonly #meanings = make("ul", { class: "meanings", "aria-label": "Colors" });
  readonly #unseen = make("p", { class: "note", id: "stations-unseen" });
  readonly #clear = button("Remove all", () => this.#keep([]), { hidden: true });
  #stations: readonly Station[] = [];
  #pins: Mark[] = [];
  /** How many stations see each point. */
  #counts: Uint8Array<ArrayBuffer> | null = null;
  #running: AbortController | null = null;

  constructor(bench: Bench, store: Store, card: HTMLElement) {
    this.#bench = bench;
    this.#store = store;
    const here = button("At the camera", () => {
      if (!bench.viewer.cloud) return;
      this.add([{ name: this.#nextName(), at: store.current.freeze ?? bench.viewer.viewpoint }]);
    });
    const row = make("div", { class: "files" }, here, this.#clear);
    card.replaceChildren(this.#said, this.#list, this.#meanings, this.#unseen, this.#height.row, row);
    store.follow((now, before) => {
      if (!bench.viewer.cloud || this.#stations.length === 0) return;
      if (JSON.stringify(methodOf(now)) !== JSON.stringify(methodOf(before))) void this.#find();
    });
    this.#invite();
  }

  /** The stations, in the order in which they were added. */
  get all(): readonly Station[] {
    return this.#stations;
  }

  /** How many points no station sees. `null`: it is not known. */
  get unseen(): number | null {
    return this.#counts && this.#counts.reduce((sum, count) => sum + Number(count === 0), 0);
  }

  add(stations: readonly Station[]): void {
    const room = MOST_STATIONS - this.#stations.length;
    this.#keep([...this.#stations, ...stations.slice(0, room)]);
    if (stations.length > room) this.#say(`The page takes ${MOST_STATIONS} stations. The others are left out.`);
  }

  click(spot: Spot): void {
    const index = this.#bench.pointAt(spot);
    if (typeof index === "string") {
      this.#say(index);
      return;
    }
    const { positions } = this.#bench.viewer.scene;
    const at = this.#bench
      .upward()
      .map((part, axis) => positions[3 * index + axis]! + part * (this.#height.input.valueAsNumber || 0));
    this.add([{ name: this.#nextName(), at: at as Viewpoint }]);
  }

  clear(): void {
    this.#running?.abort();
    this.#stations = [];
    this.#show(null);
    this.#invite();
  }

  begin(): void {
    if (this.#stations.length > 0) void this.#find();
  }

  /** The height of an instrument in the units of the cloud. */
  #invite(): void {
    const { cloud } = this.#bench.viewer;
    this.#say(INVITATION);
    if (!cloud) return;
    const { unit } = measuresOf(cloud);
    const height = unit ? USUAL_HEIGHT.meters / unit.meters : USUAL_HEIGHT.share * cloud.radius;
    this.#height.input.value = String(Number(height.toPrecision(2)));
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

  #say(sentence: string): void {
    this.#said.textContent = sentence;
  }

  #keep(stations: readonly Station[]): void {
    this.#stations = stations;
    this.#bench.changed();
    void this.#find();
  }

  /** Asks what the stations see together. It replaces the question that is under way. */
  async #find(): Promise<void> {
    this.#running?.abort();
    const { signal } = (this.#running = new AbortController());
    this.#show(null);
    this.#say(this.#stations.length > 0 ? "Finding what the stations see." : INVITATION);
    if (this.#stations.length === 0) return;
    const { inquiry } = this.#bench.viewer.scene;
    const places = this.#stations.map(({ at }) => at);
    try {
      const options = { ...inquiry.options(methodOf(this.#store.current)), signal };
      const counts = Uint8Array.from(await inquiry.cloud.coverage(places, options));
      if (signal.aborted) return;
      this.#say("");
      this.#show(counts);
    } catch (error) {
      if (!signal.aborted) this.#say(`The answer could not be found: ${(error as Error).message}.`);
    }
  }

  /** `null`: it is not known what the stations see. */
  #show(counts: Uint8Array<ArrayBuffer> | null): void {
    const { viewer, marks } = this.#bench;
    this.#counts = counts;
    for (const pin of this.#pins.splice(0)) pin.remove();
    this.#pins = this.#stations.map(({ name, at }) => marks.pin(at, name));
    this.#clear.hidden = this.#stations.length === 0;
    this.#unseen.hidden = this.#meanings.hidden = counts === null;
    this.#list.replaceChildren(
      ...this.#stations.map((station) => {
        const remove = () => this.#keep(this.#stations.filter((other) => other !== station));
        const attributes = { "aria-label": `Remove the station ${station.name}` };
        return make("li", {}, make("span", {}, station.name), button("Remove", remove, attributes));
      }),
    );
    if (counts) {
      const unseen = this.unseen!;
      const share = `${((100 * unseen) / counts.length).toFixed(1)}\u00a0%`;
      this.#unseen.textContent = `No station sees ${number.format(unseen)} of ${number.format(counts.length)} points (${share}).`;
      this.#unseen.dataset["count"] = String(unseen);
      viewer.setAttribute(STATION_COLORS, this.#colored(counts));
      this.#store.change({ color: STATION_COLORS });
    } else if (this.#stations.length === 0 && this.#store.current.color === STATION_COLORS) {
      this.#store.change({ color: OWN_COLORS });
      viewer.setAttribute(STATION_COLORS, null);
    }
  }

  /** The counts as an attribute, with the label and the color of each. Says what the colors mean; of many, some. */
  #colored(values: Uint8Array): Attribute {
    const most = values.reduce((a, b) => Math.max(a, b), 0);
    const colors = countColors(most);
    const labels = Array.from({ length: most + 1 }, (_, count) => `seen by ${count || "none"}`);
    const some = labels.flatMap((label, i) => (most < 4 || i < 2 || i === most ? [[label, colors[i]!] as const] : []));
    this.#meanings.replaceChildren(
      ...some.map(([label, color]) => {
        const swatch = make("span", { class: "swatch" });
        swatch.style.background = color;
        return make("li", {}, swatch, label);
      }),
    );
    return { name: STATION_COLORS, kind: "category", values, labels: Object.fromEntries(labels.entries()), colors };
  }
}
