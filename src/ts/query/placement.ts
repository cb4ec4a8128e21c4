import { HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";

/** What is wanted of a placement. The numbers are checked. */
export interface PlacementSettings {
  /** At most so many viewpoints are chosen. */
  count: number;
  /** The share of the weight that some candidate sees, at which the choice ends. */
  share: number;
  /** One weight for each index; 1 each if undefined. */
  weights: Float64Array<ArrayBuffer> | undefined;
}

/** Where to put viewpoints. */
export interface Placement {
  /** The numbers of the chosen candidates, in the order of their choice. */
  chosen: number[];
  /** The weight that each chosen candidate adds to those before it. */
  gains: number[];
  /** The indices that at least one chosen candidate sees, ascending. */
  seen: Uint32Array<ArrayBuffer>;
  /** The indices that no candidate sees, ascending. Removed and skipped points are among them. */
  unseen: Uint32Array<ArrayBuffer>;
  /** What is probably wrong with a camera; see `Visibility.note`. */
  note?: string;
}

/** Views are kept while they take no more memory than this, in bytes; others are asked again. */
const MOST_KEPT = 2 ** 26;

/**
 * The greedy choice: always the candidate that adds most, ties to the lowest number. A gain only falls
 * when others are chosen. So an old gain is an upper bound, and a candidate is measured again only if
 * its old gain is the highest. Sums run over ascending indices, and rounding keeps their order, so
 * this also holds for rounded sums.
 */
export class GreedyChoice {
  readonly #length: number;
  readonly #settings: PlacementSettings;
  /** The last known gain of each candidate; NaN before its first view. */
  readonly #gains: Float64Array<ArrayBuffer>;
  /** How many were chosen when the gain was measured. */
  readonly #measured: Int32Array<ArrayBuffer>;
  readonly #views = new Map<number, Uint32Array>();
  readonly #mostKept: number;
  readonly #seen: Uint8Array<ArrayBuffer>;
  readonly #seenByAny: Uint8Array<ArrayBuffer>;
  #keptBytes = 0;
  /** The last view, if it is not kept. */
  #last: { candidate: number; indices: Uint32Array } | undefined;
  #total: number | undefined;
  readonly #chosen: number[] = [];
  readonly #chosenGains: number[] = [];

  constructor(length: number, candidates: number, settings: PlacementSettings, mostKept = MOST_KEPT) {
    const { weights } = settings;
    if (weights !== undefined && weights.length !== length) {
      throw new HprError("option", `weights must be one number for each of ${length} indices, got ${weights.length}`);
    }
    this.#length = length;
    this.#settings = settings;
    this.#mostKept = mostKept;
    this.#gains = new Float64Array(candidates).fill(NaN);
    this.#measured = new Int32Array(candidates);
    this.#seen = allocating(`${length} marks`, () => new Uint8Array(length));
    this.#seenByAny = allocating(`${length} marks`, () => new Uint8Array(length));
  }

  /** Takes the view of a candidate: the indices that it sees. They are copied. */
  take(candidate: number, indices: Uint32Array): void {
    this.#measure(candidate, indices);
    for (const index of indices) this.#seenByAny[index] = 1;
    if (this.#views.has(candidate)) return;
    const own = allocating(`${indices.length} indices`, () => indices.slice());
    if (this.#keptBytes + own.byteLength <= this.#mostKept) {
      this.#keptBytes += own.byteLength;
      this.#views.set(candidate, own);
    } else {
      this.#last = { candidate, indices: own };
    }
  }

  /** Chooses as far as possible. Returns the candidates whose views are needed to go on: none at the end. */
  wanted(): number[] {
    const unknown = [...this.#gains.keys()].filter((candidate) => Number.isNaN(this.#gains[candidate]));
    if (unknown.length > 0) return unknown;
    this.#total ??= this.#weightOf(this.#seenByAny);
    while (!this.#isEnough(this.#total)) {
      const best = this.#highest();
      if (best === undefined) return [];
      const view = this.#views.get(best) ?? (this.#last?.candidate === best ? this.#last.indices : undefined);
      if (view === undefined) return [best];
      if (this.#measured[best] === this.#chosen.length) {
        this.#chosen.push(best);
        this.#chosenGains.push(this.#gains[best]!);
        for (const index of view) this.#seen[index] = 1;
        this.#gains[best] = 0;
      } else {
        this.#measure(best, view);
      }
    }
    return [];
  }

  get result(): Placement {
    return {
      chosen: this.#chosen,
      gains: this.#chosenGains,
      seen: listed(this.#seen, 1),
      unseen: listed(this.#seenByAny, 0),
    };
  }

  #isEnough(total: number): boolean {
    const { count, share } = this.#settings;
    // With a share of 1, the choice ends when nothing is gained: sums in another order may differ.
    return this.#chosen.length >= count || (share < 1 && this.#weightOf(this.#seen) >= share * total);
  }

  /** The candidate with the highest known gain, if that is above 0. */
  #highest(): number | undefined {
    let best: number | undefined;
    this.#gains.forEach((gain, candidate) => {
      if (gain > (best === undefined ? 0 : this.#gains[best]!)) best = candidate;
    });
    return best;
  }

  #measure(candidate: number, indices: Uint32Array): void {
    const { weights } = this.#settings;
    let gain = 0;
    for (const index of indices) {
      if (this.#seen[index] === 0) gain += weights === undefined ? 1 : weights[index]!;
    }
    this.#gains[candidate] = gain;
    this.#measured[candidate] = this.#chosen.length;
  }

  #weightOf(marks: Uint8Array): number {
    const { weights } = this.#settings;
    let sum = 0;
    for (let index = 0; index < this.#length; index++) {
      if (marks[index] === 1) sum += weights === undefined ? 1 : weights[index]!;
    }
    return sum;
  }
}

/** The indices with this mark. */
function listed(marks: Uint8Array, wanted: number): Uint32Array<ArrayBuffer> {
  let count = 0;
  for (const mark of marks) count += mark === wanted ? 1 : 0;
  const list = allocating(`${count} indices`, () => new Uint32Array(count));
  let at = 0;
  for (let index = 0; index < marks.length; index++) {
    if (marks[index] === wanted) list[at++] = index;
  }
  return list;
}
