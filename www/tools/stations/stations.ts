import { OWN_COLORS, type Viewpoint } from "../../settings/settings.ts";
import type { Store } from "../../settings/store.ts";
import { STATION_COLORS } from "../../settings/table.ts";
import { measuresOf } from "../figures.ts";
import type { Spot } from "../find.ts";
import type { Mark } from "../marks.ts";
import type { Bench, Tool } from "../tool.ts";
import { StationCard } from "./card.ts";
import { countColors } from "./colors.ts";
import { MOST_STATIONS, type Station } from "./station.ts";
import { type Under, type Viewshed, ViewshedFinder } from "./viewshed.ts";

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
      const { inquiry } = viewer.scene;
      const changed = JSON.stringify(inquiry.methodOf(now)) !== JSON.stringify(inquiry.methodOf(before));
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
