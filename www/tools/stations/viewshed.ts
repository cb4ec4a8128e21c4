import type { Inquiry } from "../../ask/inquiry.ts";
import type { Method } from "../../ask/question.ts";
import type { Settings, Viewpoint } from "../../settings/settings.ts";
import type { Station } from "./station.ts";

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
      const method = this.#inquiry.methodOf(settings);
      const key = JSON.stringify([at, method]);
      used.add(key);
      const mask = this.#seen.get(key) ?? (await this.#ask(at, method, signal));
      this.#seen.set(key, mask);
      masks.push(mask);
      onProgress((i + 1) / stations.length);
    }
    for (const key of this.#seen.keys()) if (!used.has(key)) this.#seen.delete(key);
    return summed(this.#inquiry.cloud.points.length, masks);
  }

  async #ask(at: Viewpoint, method: Method, signal: AbortSignal): Promise<Uint8Array> {
    const { cloud } = this.#inquiry;
    return Uint8Array.from(await cloud.points.coverage([at], { ...cloud.options(method), signal }));
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
