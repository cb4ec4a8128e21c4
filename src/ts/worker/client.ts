/// <reference lib="esnext.disposable" preserve="true" />
import type { Answers, ChosenRadius } from "../query/answers.js";
import { addDisposeSymbol } from "../base/dispose-symbol.js";
import { describe, HprError } from "../base/errors.js";
import { moduleForWorker } from "../loader.js";
import { allocating } from "../base/memory.js";
import {
  CLOUD_OPTIONS,
  type CloudSettings,
  cloudSettings,
  type CloudSize,
  givenOptions,
  pick,
  type PointCloudOptions,
} from "../query/options.js";
import { isFloatArray, type Positions, readIndices, readPositions } from "../query/positions.js";
import {
  directionQuery,
  ILLUMINATION_OPTIONS,
  type IlluminationOptions,
  illuminationQuery,
  type Query,
  type QueryKind,
  radiusQuery,
  RECONSTRUCTION_OPTIONS,
  type ReconstructionOptions,
  reconstructionQuery,
  severalQuery,
  viewQuery,
} from "../query/queries.js";
import { type RadiusRule, VIEW_OPTIONS, type VisibilityOptions } from "../query/view-options.js";
import { type Reconstruction, ReconstructionAnswer, type Visibility, VisibilityAnswer } from "../cloud/visibility.js";
import { abortError, BY_SIGNAL, readSignal, untilAborted } from "./abort.js";
import { type Progress, readProgress } from "./progress.js";
import { RequestQueue } from "./request-queue.js";
import { defaultWorkers, readWorkers } from "./workers.js";

/** How a cloud is brought to its worker. */
export interface WorkerPointCloudOptions extends PointCloudOptions {
  /**
   * Gives the positions' whole ArrayBuffer away instead of copying them: the
   * caller's array, and every other view of that buffer, is empty afterwards.
   * Only for a Float32Array or Float64Array that is not in shared memory.
   * Default false.
   */
  transfer?: boolean | undefined;
  /**
   * How many workers share every view, from 1 to 64; answers are the same, to the
   * bit. Each keeps the whole cloud in a memory of its own. By default 1 for a cloud
   * of another dimension than 3, or of fewer than 200,000 points when it is created; otherwise as many as there
   * are cores, but at most 4, and no more than hold 16 million points together.
   */
  workers?: number | undefined;
  /**
   * Puts the cloud into one worker that it shares with all others created with `shared`,
   * for pages with many clouds: their requests are answered in turn. Excludes `workers`.
   * The worker ends with the last of its clouds; one that dies takes all of them along.
   * Default false.
   */
  shared?: boolean | undefined;
  /** Gives up, with an `AbortError`, when it aborts before the cloud is ready. */
  signal?: AbortSignal | undefined;
  /**
   * Told which share of the building is done: once 0 when it is asked for, then
   * numbers that grow, and 1 before the promise resolves. What it throws is reported as
   * an uncaught error; the cloud is built all the same.
   */
  onProgress?: ((fraction: number) => void) | undefined;
}

/** When what was asked need not be answered. Every query takes these beside its own options. */
export interface RequestOptions {
  /**
   * For a viewpoint that moves: while the request still waits for its turn, a
   * newer one of the same method with `latest` takes its place, and it is rejected with an
   * `AbortError`. One that is being computed is finished. Default false.
   */
  latest?: boolean | undefined;
  /** Rejects with an `AbortError` when it aborts before the answer is there. */
  signal?: AbortSignal | undefined;
}

/** How one view is computed, and when it need not be. */
export interface WorkerVisibilityOptions extends VisibilityOptions, RequestOptions {}

const CREATE_OPTIONS = ["transfer", "workers", "shared", "signal", "onProgress"] as const;
const REQUEST_OPTIONS = ["latest", "signal"] as const;

/**
 * A point cloud in workers of its own, with the methods and the answers of
 * `PointCloud`; each returns a promise. Nothing needs to be initialized, except
 * that a wasm file in an unusual place is named by calling `init()` first: what
 * runs in the page is shared with the worker.
 *
 * If a worker dies, whatever is pending and all later calls are rejected with
 * `internal`. No copy of the positions is kept, so the cloud is lost; a new one
 * gets new workers.
 */
export class WorkerPointCloud {
  /** The same as {@link WorkerPointCloud.dispose}, on platforms that have `Symbol.dispose`. */
  declare readonly [Symbol.dispose]: () => void;

  readonly #queue: RequestQueue;
  readonly #settings: CloudSettings;
  #size: CloudSize;

  static {
    addDisposeSymbol(this.prototype);
  }

  private constructor(queue: RequestQueue, settings: CloudSettings, size: CloudSize) {
    this.#queue = queue;
    this.#settings = settings;
    this.#size = size;
    unreachable.register(this, queue, this);
  }

  /**
   * How many points were ever given, skipped and removed ones included: the next
   * index. It grows when the promise of {@link WorkerPointCloud.append} resolves.
   */
  get length(): number {
    return this.#size.length;
  }

  /** How many of the points given are left out because a coordinate is not finite. */
  get skipped(): number {
    return this.#size.skipped;
  }

  /**
   * The mean distance of a point to its 6 nearest others, in the cloud's units: what the
   * automatic rules go by. Measured at 2048 distinct points (512 beyond three dimensions)
   * where there are more; 0 where there are fewer than two.
   * It is that of the changes whose promises have resolved.
   */
  get spacing(): number {
    return this.#size.spacing;
  }

  /**
   * Starts the workers and prepares positions, in any units, in each.
   *
   * @param positions x, y, z of one point after another, copied before this returns.
   * @throws HprError (as a rejection) `option`, `positions-type`,
   *   `positions-length`, `non-finite`, `too-large`, `load`, `internal`.
   */
  static async create(positions: Positions, options?: WorkerPointCloudOptions): Promise<WorkerPointCloud> {
    const given = givenOptions(options, CLOUD_OPTIONS, CREATE_OPTIONS);
    const settings = cloudSettings(pick(given, CLOUD_OPTIONS));
    const transfer = readFlag(given, "transfer");
    const workers = readPlacement(given);
    const signal = readSignal(given["signal"]);
    const progress = readProgress(given["onProgress"]);
    if (signal?.aborted === true) {
      throw abortError(BY_SIGNAL);
    }
    const own = toOwn(positions, settings.stride, transfer);
    const queue = new RequestQueue();
    try {
      return await untilAborted(signal, WorkerPointCloud.#build(queue, own, settings, workers, progress));
    } catch (error) {
      void queue.close(abortError("the cloud was not created"));
      throw error;
    }
  }

  static async #build(
    queue: RequestQueue,
    positions: Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>,
    settings: CloudSettings,
    workers: number | "shared" | undefined,
    progress: Progress | undefined,
  ): Promise<WorkerPointCloud> {
    progress?.at(0);
    // Only views in space are divided.
    const points = settings.dimension === 3 ? positions.length / settings.stride : 0;
    const count = workers ?? (await defaultWorkers(points));
    const [module] = await Promise.all([moduleForWorker(), queue.start(count)]);
    const request = { kind: "create" as const, module, positions, settings, reporting: progress !== undefined };
    const size = await queue.ask(request, { onProgress: (share) => progress?.at(share) });
    progress?.at(1);
    return new WorkerPointCloud(queue, settings, size);
  }

  /**
   * Which points can be seen from a viewpoint; see `PointCloud.visibleFrom`.
   * Requests are answered in order.
   *
   * @param viewpoint x, y, z in the cloud's units.
   * @throws HprError (as a rejection) `viewpoint`, `option`, `radius`,
   *   `too-large`, `disposed`, `internal`.
   */
  async visibleFrom(viewpoint: ArrayLike<number>, options?: WorkerVisibilityOptions): Promise<Visibility> {
    const answer = await this.#ask("visibleFrom", options, VIEW_OPTIONS, (dimension, given) =>
      viewQuery(dimension, viewpoint, given),
    );
    return new VisibilityAnswer(answer);
  }

  /**
   * Which points can be seen along a direction; see `PointCloud.visibleFromDirection`.
   *
   * @throws HprError (as a rejection) as {@link WorkerPointCloud.visibleFrom}.
   */
  async visibleFromDirection(direction: ArrayLike<number>, options?: WorkerVisibilityOptions): Promise<Visibility> {
    const answer = await this.#ask("visibleFromDirection", options, VIEW_OPTIONS, (dimension, given) =>
      directionQuery(dimension, direction, given),
    );
    return new VisibilityAnswer(answer);
  }

  /**
   * Which points can be seen from one of several viewpoints; see `PointCloud.visibleFromAny`.
   *
   * @throws HprError (as a rejection) as {@link WorkerPointCloud.visibleFrom}.
   */
  async visibleFromAny(
    viewpoints: readonly ArrayLike<number>[],
    options?: WorkerVisibilityOptions,
  ): Promise<Visibility> {
    const answer = await this.#ask("visibleFromAny", options, VIEW_OPTIONS, (dimension, given) =>
      severalQuery(dimension, viewpoints, given),
    );
    return new VisibilityAnswer(answer);
  }

  /**
   * Which points can be seen from at least `k` of several viewpoints; see
   * `PointCloud.visibleFromAtLeast`.
   *
   * @throws HprError (as a rejection) as {@link WorkerPointCloud.visibleFrom}.
   */
  async visibleFromAtLeast(
    k: number,
    viewpoints: readonly ArrayLike<number>[],
    options?: WorkerVisibilityOptions,
  ): Promise<Visibility> {
    const answer = await this.#ask("visibleFromAtLeast", options, VIEW_OPTIONS, (dimension, given) =>
      severalQuery(dimension, viewpoints, given, { k }),
    );
    return new VisibilityAnswer(answer);
  }

  /**
   * The radius that a rule chooses for a viewpoint; see `PointCloud.autoRadius`.
   *
   * @throws HprError (as a rejection) as {@link WorkerPointCloud.visibleFrom}.
   */
  async autoRadius(viewpoint: ArrayLike<number>, rule?: RadiusRule, options?: RequestOptions): Promise<ChosenRadius> {
    return this.#ask("autoRadius", options, [], (dimension) => radiusQuery(dimension, viewpoint, rule));
  }

  /**
   * The surface that a viewpoint sees; see `PointCloud.reconstruct`.
   *
   * @throws HprError (as a rejection) as {@link WorkerPointCloud.visibleFrom}.
   */
  async reconstruct(
    viewpoint: ArrayLike<number>,
    options?: ReconstructionOptions & RequestOptions,
  ): Promise<Reconstruction> {
    const answer = await this.#ask("reconstruct", options, RECONSTRUCTION_OPTIONS, (dimension, given) =>
      reconstructionQuery(dimension, viewpoint, given),
    );
    return new ReconstructionAnswer(answer);
  }

  /**
   * Light and shadow; see `PointCloud.illuminate`.
   *
   * @throws HprError (as a rejection) as {@link WorkerPointCloud.visibleFrom}.
   */
  async illuminate(
    lights: readonly ArrayLike<number>[],
    options?: IlluminationOptions & RequestOptions,
  ): Promise<Float32Array> {
    const { brightness } = await this.#ask("illuminate", options, ILLUMINATION_OPTIONS, (dimension, given) =>
      illuminationQuery(dimension, lights, given),
    );
    return brightness;
  }

  /**
   * Adds points, which take the next indices; see `PointCloud.append`. What was
   * asked before is answered without them, what is asked after with them.
   *
   * @param positions x, y, z of one point after another, copied before this returns.
   * @throws HprError (as a rejection) `positions-type`, `positions-length`,
   *   `non-finite`, `too-large`, `disposed`, `internal`; the cloud is unchanged then.
   */
  async append(positions: Positions): Promise<void> {
    this.#queue.requireOpen();
    const own = toOwn(positions, this.#settings.stride, false);
    const request = { kind: "append" as const, positions: own };
    this.#size = await this.#queue.ask(request, { owner: this });
  }

  /**
   * Removes points; see `PointCloud.remove`. What was asked before is answered
   * with them, what is asked after without them.
   *
   * @param indices of points, in any order, copied before this returns.
   * @throws HprError (as a rejection) `option` for what is not the index of a
   *   point, `too-large`, `disposed`, `internal`; the cloud is unchanged then.
   */
  async remove(indices: ArrayLike<number>): Promise<void> {
    this.#queue.requireOpen();
    const own = readIndices(indices);
    const request = { kind: "remove" as const, indices: own };
    this.#size = await this.#queue.ask(request, { owner: this });
  }

  /**
   * Gives the memory of an answer's `indices`, which are gone then, to answers to come: for
   * a viewpoint that moves, so that no memory is left to the garbage collector. `indices`
   * may then be the start of a longer buffer. Does nothing with an answer whose indices
   * are gone already.
   *
   * @throws HprError `option` for what is no answer of a cloud.
   */
  recycle(answer: Visibility): void {
    this.#queue.recycle(VisibilityAnswer.takeMemory(answer));
  }

  /**
   * Ends the workers, which gives all of their memory back; resolves when they have
   * ended. Whatever is pending is rejected with `disposed`. May be called twice.
   */
  async dispose(): Promise<void> {
    unreachable.unregister(this);
    await this.#queue.close(new HprError("disposed", "this cloud has been disposed of"));
  }

  /** Asks what `read` makes of the options of that query, and heeds those of the request. */
  async #ask<K extends QueryKind>(
    method: string,
    options: unknown,
    names: readonly string[],
    read: (dimension: number, given: Record<string, unknown>) => Query<K>,
  ): Promise<Answers[K]> {
    this.#queue.requireOpen();
    const given = givenOptions(options, names, REQUEST_OPTIONS);
    const latest = readFlag(given, "latest") ? method : undefined;
    const signal = readSignal(given["signal"]);
    const query = read(this.#settings.dimension, given);
    return untilAborted(signal, this.#queue.query(query, { latest, signal, owner: this }));
  }
}

/** Clouds that were never disposed of: a worker would outlive them. */
const unreachable = new FinalizationRegistry<RequestQueue>((queue) => {
  void queue.close(new HprError("disposed", "this cloud has been disposed of"));
});

/** Positions that may be moved to a worker: the caller's buffer itself only if it is given away. */
function toOwn(
  positions: Positions,
  stride: number,
  transfer: boolean,
): Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer> {
  const numbers = readPositions(positions, stride);
  if (transfer) {
    return giveAway(positions, numbers);
  }
  // What was read from an array of numbers is new, and ours already.
  return isFloatArray(positions)
    ? allocating(`a copy of ${numbers.length} coordinates`, () => numbers.slice())
    : (numbers as Float64Array<ArrayBuffer>);
}

/** Moved at once, so that nothing written afterwards is part of the cloud. */
function giveAway(
  positions: Positions,
  numbers: Float32Array | Float64Array,
): Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer> {
  try {
    if (!isFloatArray(positions)) {
      throw new TypeError("an array of numbers has no buffer");
    }
    return structuredClone(numbers, { transfer: [numbers.buffer as ArrayBuffer] }) as
      Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;
  } catch (cause) {
    throw new HprError("option", `transfer is not possible for these positions: ${String(cause)}`, {
      cause,
    });
  }
}

/** How many workers of its own, or the shared one. */
function readPlacement(given: Record<string, unknown>): number | "shared" | undefined {
  const workers = readWorkers(given["workers"]);
  if (!readFlag(given, "shared")) {
    return workers;
  }
  if (workers !== undefined) {
    throw new HprError("option", "shared and workers exclude each other; give one of the two");
  }
  return "shared";
}

function readFlag(given: Record<string, unknown>, name: string): boolean {
  const value = given[name] ?? false;
  if (typeof value !== "boolean") {
    throw new HprError("option", `${name} must be true or false, got ${describe(value)}`);
  }
  return value;
}
