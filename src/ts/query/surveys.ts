import type { Found, Photographed, Query } from "./queries.js";
import { allocating, describe, HprError } from "../base/errors.js";
import { isNumberArray, plainNumbers } from "../base/typed-arrays.js";
import { freeCloud } from "../instance/engine.js";
import { type Bindings, type Instance, requireInstance } from "../instance/instance.js";
import { INVERTED, isCameraSeat, readCameras, readSeats, type Seat } from "./camera.js";
import { type CoverageOptions, MANY_ROWS, PLACEMENT_ROWS, type PlacementOptions } from "./option-rows.js";
import { type Checked, requireSpace, type Rows } from "./options.js";
import { MAX_LENGTH } from "./positions.js";
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
function readSurvey(
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

/** What is wanted of a placement. The numbers are checked. */
interface PlacementSettings {
  count: number | undefined;
  share: number;
  /** One weight for each index; 1 each if undefined. */
  weights: Float64Array<ArrayBuffer> | undefined;
}

function readPlacing({
  count,
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
  #isEnded = false;
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
    if (this.#isEnded || this.#isStopped()) {
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
    if (this.#isEnded) return;
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

  /** Whether it needs the wasm on this side, too. */
  readonly usesWasm: boolean = false;

  /** @param length the length of the cloud */
  abstract result(length: number): Result;

  /** Frees what it holds. Views that come after that are ignored. */
  end(): void {
    this.#isEnded = true;
    this.free();
  }

  protected free(): void {}

  /** Takes the answer to one view. */
  protected abstract add(number: number, found: Found): void;

  /** The viewpoints that are wanted after all others are answered. */
  protected more(): number[] {
    return [];
  }
}

class CoverageTask extends SurveyTask<Uint32Array> {
  #counts: Uint32Array<ArrayBuffer> | undefined;

  protected override add(_: number, { indices, length }: Found): void {
    const counts = (this.#counts ??= newCounts(length));
    for (const index of indices) counts[index]! += 1;
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

/** The core chooses, and says which view it needs again. */
class PlacementTask extends SurveyTask<Placement> {
  override readonly usesWasm = true;
  readonly #wanted: PlacementSettings;
  #core: { instance: Instance; handle: number } | undefined;

  constructor(survey: Survey, wanted: PlacementSettings, progress?: (fraction: number) => void) {
    super(survey, progress);
    this.#wanted = wanted;
  }

  protected override add(number: number, { indices, length }: Found): void {
    const { instance, handle } = this.#begun(length);
    instance.call((bindings) => {
      bindings.takeView(handle, number, indices);
    });
  }

  protected override more(): number[] {
    if (this.#core === undefined) return [];
    const { instance, handle } = this.#core;
    const wanted = instance.call((bindings) => bindings.chooseOn(handle));
    return wanted < 0 ? [] : [wanted];
  }

  #begun(length: number): { instance: Instance; handle: number } {
    if (this.#core === undefined) {
      const { count, share, weights } = this.#wanted;
      if (weights !== undefined && weights.length !== length) {
        throw new HprError("option", `weights must be one number for each of ${length} indices, got ${weights.length}`);
      }
      const instance = requireInstance();
      const make = (bindings: Bindings) => bindings.createChoice(length, this.count, count, share, weights);
      this.#core = { instance, handle: instance.call(make).handle };
    }
    return this.#core;
  }

  /** @param length the length of the cloud, for no candidates */
  result(length: number): Placement {
    const { instance, handle } = this.#begun(length);
    return { ...instance.call((bindings) => bindings.placed(handle)), ...this.noted };
  }

  protected override free(): void {
    if (this.#core !== undefined) freeCloud(this.#core);
  }
}

/**
 * Which cameras see each point, and where: the rows of a sparse matrix. The cameras of point i are
 * `cameras[offsets[i]]` to `cameras[offsets[i + 1] − 1]`, ascending. Entry k has the pixel
 * `pixels[2k]`, `pixels[2k + 1]`, and the direction of length 1 from the point to the camera is `towards[3k]` to
 * `towards[3k + 2]`. All arrays are the caller's own copies.
 */
export interface SeenBy {
  /** One number more than the cloud has indices. */
  offsets: Uint32Array<ArrayBuffer>;
  cameras: Uint32Array<ArrayBuffer>;
  pixels: Float32Array<ArrayBuffer>;
  towards: Float32Array<ArrayBuffer>;
  /** What is probably wrong with a camera; see `Visibility.note`. */
  note?: string;
}

/** Collects what each camera sees. The memory is that of the answer, twice. */
class SeenByTask extends SurveyTask<SeenBy> {
  readonly #views = new Map<number, { indices: Uint32Array; pixels: Float32Array; towards: Float32Array }>();

  protected override add(number: number, found: Found): void {
    const { indices, pixels, towards } = found as Required<Photographed>;
    this.#views.set(number, { indices, pixels, towards });
  }

  /** @param length the length of the cloud */
  result(length: number): SeenBy {
    const count = [...this.#views.values()].reduce((sum, { indices }) => sum + indices.length, 0);
    if (3 * count > MAX_LENGTH) {
      throw new HprError("too-large", `${3 * count} numbers exceed the limit of ${MAX_LENGTH}`);
    }
    return allocating(`${count} entries`, () => {
      const offsets = new Uint32Array(length + 1);
      for (const { indices } of this.#views.values()) for (const index of indices) offsets[index + 1]! += 1;
      for (let i = 0; i < length; i++) offsets[i + 1]! += offsets[i]!;
      const next = offsets.slice(0, length);
      const cameras = new Uint32Array(count);
      const [pixels, towards] = [new Float32Array(2 * count), new Float32Array(3 * count)];
      for (let number = 0; number < this.count; number++) {
        const view = this.#views.get(number);
        view?.indices.forEach((index, i) => {
          const at = next[index]!++;
          cameras[at] = number;
          for (let axis = 0; axis < 2; axis++) pixels[2 * at + axis] = view.pixels[2 * i + axis]!;
          for (let axis = 0; axis < 3; axis++) towards[3 * at + axis] = view.towards[3 * i + axis]!;
        });
      }
      return { offsets, cameras, pixels, towards, ...this.noted };
    });
  }
}

interface SurveyAnswers {
  coverage: Uint32Array;
  seenBy: SeenBy;
  placeViewpoints: Placement;
}

export type SurveyName = keyof SurveyAnswers;

interface Method<Answer> {
  rows: Rows;
  task: (survey: Survey, given: Record<string, unknown>, progress?: (fraction: number) => void) => SurveyTask<Answer>;
}

/** The questions about many views, for `PointCloud` and for a cloud in a worker. */
export const SURVEYS: { [Name in SurveyName]: Method<SurveyAnswers[Name]> } = {
  coverage: { rows: MANY_ROWS, task: (survey, _, progress) => new CoverageTask(survey, progress) },
  seenBy: { rows: MANY_ROWS, task: (survey, _, progress) => new SeenByTask(survey, progress) },
  placeViewpoints: {
    rows: PLACEMENT_ROWS,
    task: (survey, given, progress) => new PlacementTask(survey, readPlacing(given), progress),
  },
};

export function surveyQuestion<Name extends SurveyName>(
  name: Name,
  viewpoints: unknown,
  options: unknown,
): SurveyQuestion<SurveyAnswers[Name]> {
  const { rows, task } = SURVEYS[name];
  return [
    name,
    options,
    rows,
    (dimension, given, progress) => task(readSurvey(dimension, viewpoints, given, name), given, progress),
  ];
}
