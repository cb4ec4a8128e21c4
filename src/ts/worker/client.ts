import type { ChosenRadius, Panorama } from "../query/queries.js";
import { addDisposeSymbol, addTag } from "../base/objects.js";
import { allocating, HprError } from "../base/errors.js";
import { engine } from "../instance/own-engine.js";
import { initFrom } from "../instance/start.js";
import { moduleForWorker, ownWasm } from "../own-wasm.js";
import {
  CLOUD_OPTIONS,
  type CloudSettings,
  cloudSettings,
  type CloudSize,
  flag,
  givenOptions,
  integer,
  listener,
  pick,
  type PointCloudOptions,
  readOptions,
} from "../query/options.js";
import {
  isFloatArray,
  type Place,
  type Positions,
  readIndices,
  readPositions,
  refuseMask,
  type Viewpoint,
} from "../query/positions.js";
import { surveyed, type SurveyName, surveyQuestion, type SurveyQuestion, SURVEYS } from "../query/surveys.js";
import type { SurfaceKind } from "../query/option-types.js";
import type { PanoramaOptions } from "../query/option-rows.js";
import type { RadiusRule, VisibilityOptions } from "../query/view-options.js";
import type { PointCloud } from "../cloud/cloud.js";
import { type MethodName, METHODS, readQuestion } from "../cloud/methods.js";
import type { ScoredIf } from "../cloud/visibility.js";
import { abortError, readSignal, reasonOf, untilAborted } from "./abort.js";
import { RequestQueue } from "./request-queue.js";
import { ViewStream, type ViewStreamOptions } from "./view-stream.js";
import { MAX_WORKERS } from "./team.js";

/// <reference lib="esnext.disposable" preserve="true" />

/** How a cloud is sent to its worker. */
export interface WorkerPointCloudOptions extends PointCloudOptions {
  /**
   * Moves the whole ArrayBuffer of the positions to the worker instead of copying them. After that,
   * the caller's array and every other view of that buffer are empty. Works only for a Float32Array
   * or Float64Array that is not in shared memory. Otherwise the page keeps the copy, so that workers that
   * hang can be replaced. Default false.
   */
  transfer?: boolean | undefined;
  /**
   * How many workers share the viewpoints of `coverage`, `seenBy`, `placeViewpoints` and `transfer`, from 1 to 64. The
   * answers are the same, to the bit. Each worker keeps the whole cloud in its own memory. A single view is answered by
   * one worker. Default 1.
   */
  workers?: number | undefined;
  /**
   * Puts the cloud into one worker that it shares with all other clouds created with `shared`. This
   * is for pages with many clouds. The worker answers the requests of its clouds in turn. Excludes
   * `workers`. The worker ends with the last of its clouds. If it dies, all of them are lost.
   * Default false.
   */
  shared?: boolean | undefined;
  /**
   * Gives the creation up, with its reason, if the signal aborts before the cloud is ready.
   */
  signal?: AbortSignal | undefined;
  /**
   * Is told the share of the building that is done: 0 at first, then growing numbers, and 1 before
   * the promise resolves. If it throws, the error is reported as uncaught, and the cloud is built
   * all the same.
   */
  onProgress?: ((fraction: number) => void) | undefined;
}

/** When a request need not be answered. Every query takes these options beside its own. */
export interface RequestOptions {
  /**
   * For a viewpoint that moves. While the request waits for its turn, a newer request of the same
   * method with `latest` takes its place, and an `AbortError` rejects the older one. A request that
   * is being computed is finished. Default false.
   */
  latest?: boolean | undefined;
  /** Rejects with the signal's reason (an `AbortError` without one) if it aborts before the answer arrives. */
  signal?: AbortSignal | undefined;
}

/** How one view is computed, and when it need not be computed. */
export type WorkerVisibilityOptions = VisibilityOptions & RequestOptions;

const CREATE_OPTIONS = ["transfer", "workers", "shared", "signal", "onProgress"] as const;
const REQUEST_OPTIONS = ["latest", "signal"] as const;

/** A method of `PointCloud` that returns a promise and takes {@link RequestOptions} beside its own options. */
type Promised<Method> = Method extends (...args: [...infer Head, (infer Options)?]) => infer Answer
  ? (...args: [...Head, options?: Options & RequestOptions]) => Promise<Answer>
  : never;

type Asked = Pick<PointCloud, Exclude<MethodName | SurveyName, "autoRadius" | "panorama" | "visibleFrom">>;

/**
 * The questions to a cloud, as promises. Requests are answered in order. The workers share the viewpoints of `coverage`,
 * `seenBy` and `placeViewpoints`; if the signal aborts, no further one is asked.
 */
export type PromisedQuestions = {
  // By the names of another type, whose comments the methods keep.
  [Name in keyof Asked]: Promised<Asked[Name]>;
} & {
  /** Finds the points that can be seen from a viewpoint; see `PointCloud.visibleFrom`. */
  visibleFrom<Scores extends boolean = false>(
    viewpoint: Viewpoint,
    options?: WorkerVisibilityOptions & { scores?: Scores | undefined },
  ): Promise<ScoredIf<Scores>>;
  /** What stands in each direction around a viewpoint; see `PointCloud.panorama`. */
  panorama(viewpoint: Viewpoint, options: PanoramaOptions & RequestOptions): Promise<Panorama>;
  /** The radius that a rule chooses for a viewpoint; see `PointCloud.autoRadius`. */
  autoRadius(viewpoint: Viewpoint, rule?: RadiusRule, options?: RequestOptions): Promise<ChosenRadius>;
};

// The class has these methods from the table of methods.
// oxlint-disable-next-line typescript/no-empty-object-type, typescript/no-unsafe-declaration-merging
export interface WorkerPointCloud extends PromisedQuestions {}

/**
 * A point cloud in its own workers, with the methods and the answers of `PointCloud`. Each method
 * returns a promise. Nothing needs to be initialized. Only if the wasm file is in an unusual place,
 * call `init()` with its address first: the worker uses the same wasm as the page.
 *
 * If a worker dies, all pending and later calls are rejected with `internal`. The cloud is lost, and a new
 * cloud gets new workers. A worker that computes says so about every half second. If it is silent for
 * 20 seconds in which the page runs, it is replaced once and asked again; if its successor is silent, too, or
 * if the positions were given away (`transfer`), the calls are rejected with `internal`.
 */
export class WorkerPointCloud {
  /** The same as {@link WorkerPointCloud.dispose}, on platforms that have `Symbol.dispose`. */
  declare readonly [Symbol.dispose]: () => void;

  readonly #queue: RequestQueue;
  readonly #settings: CloudSettings;
  #size: CloudSize;

  static {
    addDisposeSymbol(this.prototype);
    addTag(this.prototype, "WorkerPointCloud");
    for (const name of Object.keys({ ...METHODS, ...SURVEYS }) as (MethodName | SurveyName)[]) {
      const value = async function (this: WorkerPointCloud, ...args: unknown[]) {
        return name in SURVEYS
          ? this.#survey(surveyQuestion(name as SurveyName, args[0], args[1]))
          : this.#ask(name as MethodName, args);
      };
      Object.defineProperty(this.prototype, name, { value, writable: true, configurable: true });
    }
  }

  private constructor(queue: RequestQueue, settings: CloudSettings, size: CloudSize) {
    this.#queue = queue;
    this.#settings = settings;
    this.#size = size;
    unreachable.register(this, queue, this);
    surveyed.set(this, (question) => this.#survey(question));
  }

  /**
   * The number of all points ever given, with the skipped and the removed ones. This is also the
   * next index. It grows when the promise of {@link WorkerPointCloud.append} resolves.
   */
  get length(): number {
    return this.#size.length;
  }

  /** How many of the given points are left out because a coordinate is not finite. */
  get skipped(): number {
    return this.#size.skipped;
  }

  /**
   * The mean distance of a point to its 6 nearest neighbors, in the cloud's units. The automatic
   * rules use it. It is measured at 2048 distinct points (512 above three dimensions), or at all
   * points if there are fewer. It is 0 for fewer than two points. It includes the changes whose
   * promises have resolved.
   */
  get spacing(): number {
    return this.#size.spacing;
  }

  /**
   * Starts the workers and prepares the positions, in any units, in each of them.
   *
   * @param positions x, y, z of one point after another, copied before this returns.
   * @throws HprError (as a rejection) `option`, `positions-type`,
   *   `positions-length`, `non-finite`, `too-large`, `load`, `internal`.
   */
  static async create(positions: Positions, options?: WorkerPointCloudOptions): Promise<WorkerPointCloud> {
    const given = givenOptions(options, CLOUD_OPTIONS, CREATE_OPTIONS);
    const settings = cloudSettings(pick(given, CLOUD_OPTIONS));
    const transfer = flag(given, "transfer");
    const workers = readPlacement(given);
    const signal = readSignal(given["signal"]);
    const progress = readProgress(given);
    if (signal?.aborted === true) {
      throw reasonOf(signal);
    }
    const own = toOwn(positions, settings.stride, transfer);
    const queue = new RequestQueue(!transfer);
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
    workers: number | "shared",
    progress: Progress | undefined,
  ): Promise<WorkerPointCloud> {
    progress?.at(0);
    const [module] = await Promise.all([moduleForWorker(), queue.start(workers)]);
    const request = { kind: "create" as const, module, positions, settings, reporting: progress !== undefined };
    const size = await queue.ask(request, { onProgress: (share) => progress?.at(share) });
    progress?.at(1);
    return new WorkerPointCloud(queue, settings, size);
  }

  /**
   * Follows a viewpoint that moves. See {@link ViewStream}.
   *
   * @throws HprError `option`, `disposed`.
   */
  follow(options?: ViewStreamOptions): ViewStream {
    this.#queue.requireOpen();
    const { dimension } = this.#settings;
    const ask = ({ from, isDirection }: Place, asked: WorkerVisibilityOptions) =>
      isDirection ? this.visibleFromDirection(from, asked) : this.visibleFrom(from.slice(0, dimension), asked);
    return new ViewStream({ dimension, size: () => this.#size, ask }, options);
  }

  /**
   * How far measured points lie off their surface; see `PointCloud.noise`.
   *
   * @throws HprError (as a rejection) the same as `PointCloud.noise`.
   */
  get noise(): Promise<number> {
    return this.#queue.query({ kind: "noise" }, { owner: this }).then(({ noise }) => noise);
  }

  /**
   * What the survey of the points found; see `PointCloud.surface`.
   *
   * @throws HprError (as a rejection) the same as `PointCloud.surface`.
   */
  get surface(): Promise<SurfaceKind> {
    return this.#queue.query({ kind: "surface" }, { owner: this }).then(({ surface }) => surface);
  }

  /**
   * Adds points, which take the next indices; see `PointCloud.append`. Requests made before this
   * are answered without the new points. Later requests are answered with them.
   *
   * @param positions x, y, z of one point after another, copied before this returns.
   * @throws HprError (as a rejection) `positions-type`, `positions-length`, `non-finite`,
   *   `too-large`, `disposed`, `internal`. Then the cloud is unchanged.
   */
  async append(positions: Positions): Promise<void> {
    this.#queue.requireOpen();
    const own = toOwn(positions, this.#settings.stride, false);
    const request = { kind: "append" as const, positions: own };
    this.#size = await this.#queue.ask(request, { owner: this });
  }

  /**
   * Removes points; see `PointCloud.remove`. Requests made before this are answered with these
   * points. Later requests are answered without them.
   *
   * @param indices indices of points, in any order, copied before this returns.
   * @throws HprError (as a rejection) `option` for a value that is not the index of a point,
   *   `too-large`, `disposed`, `internal`. Then the cloud is unchanged.
   */
  async remove(indices: ArrayLike<number>): Promise<void> {
    this.#queue.requireOpen();
    const own = readIndices(indices);
    refuseMask(own, this.length);
    const request = { kind: "remove" as const, indices: own };
    this.#size = await this.#queue.ask(request, { owner: this });
  }

  /**
   * Ends the workers, which frees all of their memory. Resolves when they have ended. Pending
   * requests are rejected with `disposed`. May be called twice.
   */
  async dispose(): Promise<void> {
    unreachable.unregister(this);
    await this.#queue.close(new HprError("disposed", "this cloud has been disposed of"));
  }

  /** Answers all views of a task, as the options of the request say. */
  async #survey<Result>([method, options, rows, read]: SurveyQuestion<Result>): Promise<Result> {
    this.#queue.requireOpen();
    const given = readOptions(options, rows, this.#settings.dimension, REQUEST_OPTIONS);
    const latest = flag(given, "latest") ? method : undefined;
    const signal = readSignal(given["signal"]);
    const progress = readProgress(given);
    const task = read(this.#settings.dimension, given, (fraction) => progress?.at(fraction));
    if (signal !== undefined) task.stopWhen(() => signal.aborted);
    const ready = task.usesWasm ? initFrom(engine, ownWasm(), undefined) : Promise.resolve();
    // The queue hears of a failure as soon as it is the turn of this request.
    ready.catch(() => undefined);
    const asked = this.#queue.ask({ kind: "survey", task, ready }, { latest, signal, owner: this });
    try {
      await untilAborted(signal, asked);
      return task.result(this.length);
    } finally {
      task.end();
    }
  }

  async #ask(name: MethodName, args: readonly unknown[]): Promise<unknown> {
    this.#queue.requireOpen();
    const { query, given, answer } = readQuestion(name, this.#settings, args, REQUEST_OPTIONS);
    const latest = flag(given, "latest") ? name : undefined;
    const signal = readSignal(given["signal"]);
    return answer((await untilAborted(signal, this.#queue.query(query, { latest, signal, owner: this }))) as never);
  }
}

/** For clouds that nobody disposes of: otherwise, a worker would outlive its cloud. */
const unreachable = new FinalizationRegistry<RequestQueue>((queue) => {
  void queue.close(new HprError("disposed", "this cloud has been disposed of"));
});

/**
 * Positions that may be moved to a worker. The caller's own buffer is moved only with `transfer`.
 */
function toOwn(
  positions: Positions,
  stride: number,
  transfer: boolean,
): Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer> {
  const numbers = readPositions(positions, stride);
  if (transfer) {
    return giveAway(positions, numbers);
  }
  // An array of numbers was read into a new buffer, which need not be copied.
  return isFloatArray(positions)
    ? allocating(`a copy of ${numbers.length} coordinates`, () => numbers.slice())
    : (numbers as Float64Array<ArrayBuffer>);
}

/** Moves the buffer at once, so that later writes do not change the cloud. */
function giveAway(
  positions: Positions,
  numbers: Float32Array | Float64Array,
): Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer> {
  try {
    if (!isFloatArray(positions)) {
      throw new TypeError("an array of numbers has no buffer");
    }
    return structuredClone(numbers, { transfer: [numbers.buffer as ArrayBuffer] }) as ReturnType<typeof giveAway>;
  } catch (cause) {
    throw new HprError("option", `transfer is not possible for these positions: ${String(cause)}`, {
      cause,
    });
  }
}

/** Starts this cloud's own workers, or joins the shared one. */
function readPlacement(given: Record<string, unknown>): number | "shared" {
  const workers = integer(given, "workers", 1, MAX_WORKERS);
  if (!flag(given, "shared")) {
    return workers ?? 1;
  }
  if (workers !== undefined) {
    throw new HprError("option", "shared and workers exclude each other; give one of the two");
  }
  return "shared";
}

/** Tells a listener the progress of a task. The numbers only grow. */
export class Progress {
  readonly #listener: (fraction: number) => void;
  #last = -1;

  constructor(listener: (fraction: number) => void) {
    this.#listener = listener;
  }

  at(fraction: number): void {
    if (fraction > this.#last) {
      this.#last = fraction;
      // This runs in a task of its own: an error of the listener must not disturb the caller.
      queueMicrotask(() => {
        this.#listener(fraction);
      });
    }
  }
}

/** The option `onProgress`. */
export function readProgress(given: Record<string, unknown>): Progress | undefined {
  const told = listener(given, "onProgress");
  return told && new Progress(told as (fraction: number) => void);
}
