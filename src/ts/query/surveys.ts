import type { Found } from "./answers.js";
import { describe, HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { isNumberArray, plainNumbers } from "../base/typed-arrays.js";
import { INVERTED } from "./camera.js";
import type { CoverageOptions, PLACEMENT_ROWS, PlacementOptions } from "./option-rows.js";
import { type Checked, requireSpace, type Rows } from "./options.js";
import { GreedyChoice, type Placement, type PlacementSettings } from "./placement.js";
import type { Query } from "./queries.js";
import { isCameraSeat, readCameras, readSeats, type Seat } from "./seats.js";
import { hasScores, refuseScores, type ViewSettings, viewSettings } from "./view-options.js";

export type { CoverageOptions, PlacementOptions };

/** Many viewpoints of one cloud, each asked with the same settings. */
export interface Survey {
  seats: Seat[];
  settings: ViewSettings;
  /** Whether the answers have `towards`. */
  towards: boolean;
}

/** The question of one view of a survey. */
type View = Query<"visibleFrom"> | Query<"visibleFromCamera">;

type GivenOptions = Record<string, unknown>;

/** @param method the name of the method, for messages */
export function readSurvey(
  dimension: number,
  viewpoints: unknown,
  given: GivenOptions,
  method: "coverage" | "placeViewpoints" | "seenBy",
): Survey {
  if (method === "seenBy") requireSpace(method, dimension);
  const seats =
    method === "seenBy"
      ? readCameras(viewpoints)
      : readSeats(viewpoints, dimension, method === "coverage" ? "viewpoints" : "candidates");
  const settings = viewSettings(given, dimension);
  refuseScores({ scores: hasScores(settings) }, method);
  return { seats, settings, towards: method === "seenBy" };
}

export function readPlacing({
  count = Infinity,
  share = 1,
  weights,
}: Checked<PlacementOptions, typeof PLACEMENT_ROWS>): PlacementSettings {
  return { count, share, weights: weights === undefined ? undefined : readWeights(weights) };
}

/** The numbers are copied. Their number is checked when the length of the cloud is known. */
function readWeights(weights: unknown): Float64Array<ArrayBuffer> {
  const list = isNumberArray(weights)
    ? plainNumbers(weights)
    : Array.isArray(weights)
      ? (weights as unknown[])
      : undefined;
  if (list === undefined) {
    throw new HprError("option", `weights must be an array of numbers, got ${describe(weights)}`);
  }
  const own = allocating(`${list.length} weights`, () => new Float64Array(list.length));
  for (let i = 0; i < list.length; i++) {
    const weight = list[i];
    if (typeof weight !== "number" || !(weight >= 0 && weight < Infinity)) {
      throw new HprError("option", `weights[${i}] must be finite and at least 0, got ${describe(weight)}`);
    }
    own[i] = weight;
  }
  return own;
}

/** The view from one of several seats, by one worker. */
export function viewFrom(seats: readonly Seat[], at: number, settings: ViewSettings, towards = false): View {
  const seat = seats[at]!;
  return isCameraSeat(seat)
    ? { kind: "visibleFromCamera", camera: seat, settings, towards, argument: `camera ${at}` }
    : { kind: "visibleFrom", viewpoint: seat, settings, argument: `viewpoint ${at}` };
}

/** The question of a survey: its name, the options with their rows, and how they become a task. */
export type SurveyQuestion<Result> = [
  method: string,
  options: unknown,
  rows: Rows,
  read: (dimension: number, given: GivenOptions, progress?: (fraction: number) => void) => SurveyTask<Result>,
];

/** How each cloud, here or in workers, answers a survey. It is no part of the public types. */
export const surveyed = new WeakMap<object, <Result>(question: SurveyQuestion<Result>) => Result | Promise<Result>>();

/** Many views of one cloud, whose answers come in any order. */
export abstract class SurveyTask<Result = unknown> {
  readonly #survey: Survey;
  #wanted: number[];
  readonly #progress: ((fraction: number) => void) | undefined;
  /** The views that were asked and are not answered yet. */
  readonly #asked = new Set<number>();
  /** The cameras whose poses were probably given the wrong way round. */
  readonly #inverted = new Set<number>();
  #taken = 0;
  #isStopped = () => false;

  constructor(survey: Survey, progress?: (fraction: number) => void) {
    this.#survey = survey;
    this.#wanted = [...survey.seats.keys()].reverse();
    this.#progress = progress;
  }

  /** Asks nothing more as soon as this is true. */
  stopWhen(isStopped: () => boolean): void {
    this.#isStopped = isStopped;
  }

  /** Asks the views again that were asked and not answered, because whoever was asked is gone. */
  resume(): void {
    this.#wanted.push(...this.#asked);
    this.#asked.clear();
  }

  /** The next view, if one is known. `running` views have no answer yet. */
  next(running: number): { number: number; view: View } | undefined {
    if (this.#isStopped()) {
      return undefined;
    }
    if (this.#wanted.length === 0 && running === 0) {
      this.#wanted = this.more();
    }
    const number = this.#wanted.pop();
    if (number === undefined) {
      return undefined;
    }
    this.#asked.add(number);
    const { seats, settings, towards } = this.#survey;
    return { number, view: viewFrom(seats, number, settings, towards) };
  }

  take(number: number, found: Found): void {
    this.#asked.delete(number);
    this.add(number, found);
    if (found.inverted === true) {
      this.#inverted.add(number);
    }
    this.#taken += 1;
    // Views that are asked again do not count.
    this.#progress?.(Math.min(this.#taken / this.count, 1));
  }

  protected get count(): number {
    return this.#survey.seats.length;
  }

  /** What is probably wrong with cameras. */
  protected get noted(): { note?: string } {
    const count = this.#inverted.size;
    if (count === 0) {
      return {};
    }
    const others = count > 1 ? ` (of ${this.count} cameras, ${count} are so)` : "";
    return { note: `camera ${Math.min(...this.#inverted)}: ${INVERTED}${others}` };
  }

  /** @param length the length of the cloud */
  abstract result(length: number): Result;

  /** Takes the answer to one view. */
  protected abstract add(number: number, found: Found): void;

  /** The viewpoints that are wanted after all others are answered. */
  protected abstract more(): number[];
}

export class CoverageTask extends SurveyTask<Uint32Array> {
  #counts: Uint32Array<ArrayBuffer> | undefined;

  protected override add(_: number, { indices, length }: Found): void {
    const counts = (this.#counts ??= newCounts(length));
    for (const index of indices) counts[index]! += 1;
  }

  protected override more(): number[] {
    return [];
  }

  /** @param length the length of the cloud, for no viewpoints */
  result(length: number): Uint32Array {
    const { note } = this.noted;
    if (note !== undefined) {
      console.warn(note); // an array has no place for it
    }
    return this.#counts ?? newCounts(length);
  }
}

export function newCounts(length: number): Uint32Array<ArrayBuffer> {
  return allocating(`${length} counts`, () => new Uint32Array(length));
}

export class PlacementTask extends SurveyTask<Placement> {
  readonly #wanted: PlacementSettings;
  #choice: GreedyChoice | undefined;

  constructor(survey: Survey, wanted: PlacementSettings, progress?: (fraction: number) => void) {
    super(survey, progress);
    this.#wanted = wanted;
  }

  protected override add(number: number, { indices, length }: Found): void {
    this.#choice ??= new GreedyChoice(length, this.count, this.#wanted);
    this.#choice.take(number, indices);
  }

  protected override more(): number[] {
    return this.#choice?.wanted() ?? [];
  }

  /** @param length the length of the cloud, for no candidates */
  result(length: number): Placement {
    return { ...(this.#choice ?? new GreedyChoice(length, 0, this.#wanted)).result, ...this.noted };
  }
}
