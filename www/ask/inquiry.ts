import { HprError, type VisibilityMap } from "hidden-point-removal";
import { type AskedStage, Follower, Refinement, type Round, type Stage } from "hidden-point-removal/worker";
import type { Cloud } from "../cloud/cloud.ts";
import type { Settings, Viewpoint } from "../settings/settings.ts";
import {
  askMap,
  askView,
  isSamePlace,
  isSameView,
  kindOf,
  mappedStagesOf,
  type Method,
  stagesOf,
  type ViewAnswer,
  viewOf,
  type ViewQuestion,
  type WorkerCloud,
} from "./question.ts";

export interface TimedView extends ViewAnswer {
  /** `part`: an answer about those points alone that were read of a streamed octree. */
  kind: "operator" | "looks" | "part";
  /** The time of the question (performance.now), and how long the answer took, without the time of waiting. */
  asked: number;
  milliseconds: number;
  /** The number of points of a cloud of which only a part is in memory, and the answer in words. */
  whole?: { total: number; sentence: string };
}

/** Points that were read for one viewpoint, with the answer about them. */
export interface Detail {
  cloud: Cloud;
  positions: Float32Array | Float64Array;
  inquiry: Inquiry;
  answer: TimedView;
}

/** A map, and the viewpoint that was asked about. */
export interface Mapped {
  map: VisibilityMap;
  viewpoint: Viewpoint;
  milliseconds: number;
}

/** Below this number of points, one hull takes about as long as a frame, so nobody waits for a map. */
const MAPS_FROM = 50_000;
/** A viewpoint that has not moved for this number of milliseconds, and in this number of frames, is at rest. */
const REST = 250;
const STILL = 2;
/** A lost worker is replaced once. After that, the user decides. */
const ONCE = { delays: [0], pause: Infinity, longPause: Infinity };

/**
 * Keeps the answer up to date with the viewpoint and the settings. It is asked again only if something that it depends on
 * has changed.
 */
export class Inquiry {
  onView: (answer: TimedView) => void = () => undefined;
  /** A map stands in for the answer, until the viewpoint rests. */
  onMap: (mapped: Mapped) => void = () => undefined;
  onError: (error: unknown) => void = () => undefined;
  /** Points to be shown instead of the cloud; `null`: the cloud again. Returns whether they are shown. */
  onDetail: (detail: Detail | null) => boolean = () => false;

  /** The cloud in its worker, also for questions that are not for the picture. */
  cloud: WorkerCloud;
  readonly #another: () => Promise<WorkerCloud>;
  readonly #size: number;
  /** How far the answers for the viewpoint have come: see `stagesOf`. */
  readonly #refinement = new Refinement<ViewQuestion>(() => this.#viewFollower.follow());
  /** The question whose answer is final. */
  #wanted: ViewQuestion | null = null;
  /** The question that was answered last. */
  #answered: ViewQuestion | null = null;
  /** Whether the worker is gone, and another one must hold the cloud. */
  #isLost = false;
  readonly #viewFollower = new Follower(
    {
      next: () => (this.#isLost ? this.#remaking() : this.#viewRound()),
      refused: (error) => this.onError(error),
      lost: (isComingBack) => {
        this.#isLost = true;
        if (isComingBack) this.#refinement.begin(this.#stages);
      },
    },
    ONCE,
  );
  /** Since when the worker can take the next question. */
  #freeSince = 0;
  #hasMaps = false;
  #upToDate = false;
  /** In how many frames in turn the viewpoint has not moved. A frame of a large cloud may take longer than a rest. */
  #still = STILL;

  /** `another` makes a lost cloud again. */
  constructor(cloud: WorkerCloud, another: () => Promise<WorkerCloud>, size: number) {
    this.cloud = cloud;
    this.#another = another;
    this.#size = size;
  }

  /** Whether the last question still waits for its answer. */
  get busy(): boolean {
    return !this.#upToDate;
  }

  /** Returns the first answer. Nothing is shown before it. */
  async first(viewpoint: Viewpoint, settings: Settings): Promise<TimedView> {
    this.#wanted = viewOf(viewpoint, settings);
    // The first viewpoint counts as being at rest.
    this.#refinement.begin(this.#stages);
    const asked = async () => {
      const round = this.#asking((stage) => this.#ask(stage));
      const view = await round.ask();
      round.use(view);
      return view;
    };
    try {
      return await asked();
    } catch (error) {
      if (!isHang(error)) throw error;
      this.cloud = await this.#another();
      this.#refinement.begin(this.#stages);
      return asked();
    }
  }

  /** Called every frame and after every change. Does nothing while the questions stay the same. */
  follow(viewpoint: Viewpoint, settings: Settings): void {
    this.#wantView(viewOf(viewpoint, settings));
    this.#viewFollower.follow();
    this.#upToDate = this.#viewFollower.isLost || this.#refinement.isSettled;
  }

  /** Makes a lost worker again, after `onError`. */
  restart(): void {
    this.#refinement.begin(this.#stages);
    this.#viewFollower.restart();
  }

  /** Asks a question that is not for the picture. Questions for the picture go first. */
  async aside(question: ViewQuestion): Promise<ViewAnswer> {
    const answer = await askView(this.cloud, question);
    this.#freeSince = performance.now();
    return answer;
  }

  /** How the final answer is found with these settings. */
  methodOf(settings: Settings): Method {
    return viewOf(this.cloud.center, settings).method;
  }

  /** The cloud's spacing in its own units. 0 if it has none. */
  get spacing(): number {
    return this.cloud.points.spacing;
  }

  dispose(): void {
    this.onMap = this.onView = this.onError = () => undefined;
    this.#refinement.stop();
    this.#viewFollower.stop();
    void this.cloud.points.dispose();
  }

  /** The answer as others are told it. */
  protected told(view: TimedView): TimedView {
    return view;
  }

  get #stages(): Stage<ViewQuestion>[] {
    const isLarge = this.cloud.points.length >= MAPS_FROM;
    // The first answer is awaited, so it has to be one.
    const mapped = isLarge && this.#answered !== null ? mappedStagesOf(this.#wanted!) : null;
    return (mapped ?? stagesOf(this.#wanted!)).map((question) => ({
      kind: kindOf(question),
      options: question,
      rest: question.map ? 0 : mapped !== null || question.method.looks > 0 ? REST : 0,
    }));
  }

  #wantView(question: ViewQuestion): void {
    const before = this.#wanted;
    this.#still++;
    if (before && isSameView(question, before, this.#size)) return;
    this.#wanted = question;
    const stages = this.#stages;
    if (before && isSamePlace(question.viewpoint, before.viewpoint, this.#size)) {
      this.#refinement.begin(stages, this.#firstOf(stages));
    } else {
      this.#still = 0;
      this.#refinement.moved(stages);
    }
  }

  /**
   * The number of the stage that comes first when only settings have changed: the final one, since an earlier one would
   * show points that the picture no longer has.
   */
  #firstOf(stages: Stage<ViewQuestion>[]): number {
    const last = this.#answered;
    if (!last || !isSamePlace(last.viewpoint, this.#wanted!.viewpoint, this.#size)) return 0;
    return isSameView(last, this.#wanted!, this.#size) ? stages.length : stages.length - 1;
  }

  #viewRound(): Round | undefined {
    const { due } = this.#refinement;
    if (!due || (due.rest > 0 && this.#still < STILL)) return undefined;
    if (due.kind === "map") return this.#mapRound();
    return this.#asking(async (stage) => {
      const view = await this.#ask(stage);
      this.onView(view);
      this.#viewFollower.answered();
      if (isSameView(view.question, this.#wanted!, this.#size)) this.#prepareMaps(view.question);
      return view;
    });
  }

  /** The first map of a cloud takes longer, so it is made before the camera moves. */
  #prepareMaps(question: ViewQuestion): void {
    if (this.#hasMaps || this.cloud.points.length < MAPS_FROM) return;
    this.#hasMaps = true;
    // If it is refused, the first move says why.
    askMap(this.cloud, question).catch(() => undefined);
  }

  #mapRound(): Round {
    return this.#refinement.round(
      async ({ options: question, points }) => {
        const begun = performance.now();
        const map = await askMap(this.cloud, question, points);
        this.#freeSince = performance.now();
        this.onMap({ map, viewpoint: question.viewpoint, milliseconds: performance.now() - begun });
        this.#viewFollower.answered();
      },
      () => undefined,
    );
  }

  #asking(ask: (stage: AskedStage<ViewQuestion>) => Promise<TimedView>): Round<TimedView> {
    return this.#refinement.round(ask, () => undefined);
  }

  /** Makes the cloud again in another worker. */
  #remaking(): Round<WorkerCloud> {
    return {
      ask: () =>
        this.#another().catch((cause: unknown) => {
          throw new HprError("internal", cause instanceof Error ? cause.message : String(cause), { cause });
        }),
      use: (cloud) => {
        void this.cloud.points.dispose();
        this.cloud = cloud;
        this.#isLost = false;
        return undefined;
      },
      leave: ({ points }) => void points.dispose(),
    };
  }

  async #ask({ options: question, signal }: AskedStage<ViewQuestion>): Promise<TimedView> {
    const asked = performance.now();
    const answer = await askView(this.cloud, question, signal);
    const begun = Math.max(asked, this.#freeSince);
    this.#freeSince = performance.now();
    this.#answered = question;
    const kind = kindOf(question) as TimedView["kind"];
    return this.told({ ...answer, kind, asked, milliseconds: this.#freeSince - begun });
  }
}

/** Whether a worker has given no sign of life for too long. */
export function isHang(error: unknown): boolean {
  const cause = error instanceof HprError && error.cause;
  return cause instanceof DOMException && cause.name === "TimeoutError";
}
