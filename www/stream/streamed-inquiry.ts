import { Inquiry, type TimedView } from "../ask/inquiry.ts";
import { isSamePlace, viewOf } from "../ask/question.ts";
import type { WorkerCloud } from "../ask/worker-cloud.ts";
import type { Cloud, Streamed } from "../cloud/cloud.ts";
import type { Settings, Viewpoint } from "../settings/settings.ts";
import { detailOf } from "./detail.ts";
import { streamMethodOf } from "./method.ts";
import type { StreamStep, StreamView } from "./protocol.ts";
import { OctreeReader } from "./reader.ts";
import { ONLY_OVERVIEW, sentenceOfOverview, sentenceOfStep } from "./words.ts";

/** After this number of milliseconds without a move, the octree is read for the viewpoint. */
const REST = 250;
/** Before another step is shown, the octree is read for this number of milliseconds, or as often as the last one took. */
const CALM = { least: 700, times: 4 };

/**
 * The inquiry about an octree that is too large to be in memory. While the camera moves, the points of the coarser levels
 * (the overview) answer. When it rests, the octree is read, and the visible points replace the overview:
 *
 *     moving: overview ─► at rest: step, step, … ─► the exact points ─► moving: overview
 */
export class StreamedInquiry extends Inquiry {
  readonly #overview: Cloud;
  readonly #total: number;
  readonly #reader: OctreeReader;
  #movedAt = -Infinity;
  #settings: Settings | null = null;
  #wanted: StreamView | null = null;
  /** The view that is being read, or was. */
  #begun: StreamView | null = null;
  #isEnded = false;
  #isDetailShown = false;
  /** The number of visible points that are on screen. */
  #count = 0;
  /** The earliest time of the next step. */
  #notBefore = 0;

  constructor(cloud: WorkerCloud, another: () => Promise<WorkerCloud>, overview: Cloud, streamed: Streamed) {
    super(cloud, another, overview.radius);
    this.#overview = overview;
    this.#total = streamed.points;
    this.#reader = new OctreeReader(streamed);
  }

  override get busy(): boolean {
    return this.#wanted === null ? super.busy : !this.#isEnded;
  }

  override async first(viewpoint: Viewpoint, settings: Settings): Promise<TimedView> {
    this.#settings = settings;
    return super.first(viewpoint, overviewSettings(settings));
  }

  override follow(viewpoint: Viewpoint, settings: Settings): void {
    this.#settings = settings;
    this.#want(viewpoint, settings);
    super.follow(viewpoint, overviewSettings(settings));
    const isAtRest = performance.now() >= this.#movedAt + REST;
    if (this.#wanted && !this.#begun && isAtRest && !super.busy) this.#begin(this.#wanted);
  }

  override dispose(): void {
    super.dispose();
    this.onDetail = () => false;
    this.#stop();
    this.#reader.dispose();
  }

  /** Answers about the overview are about a part. If the octree cannot be read with these settings, a note says so. */
  protected override told(view: TimedView): TimedView {
    const { count } = view.visibility;
    this.#count = count;
    const sentence = sentenceOfOverview(count, this.#overview.count, this.#total);
    const note = streamMethodOf(this.#settings!) === null ? ONLY_OVERVIEW : view.note;
    return { ...view, kind: "part", note, whole: { total: this.#total, sentence } };
  }

  #want(viewpoint: Viewpoint, settings: Settings): void {
    const method = streamMethodOf(settings);
    const before = this.#wanted;
    const isSame =
      before !== null &&
      method !== null &&
      isSamePlace(viewpoint, before.viewpoint, this.#overview.radius) &&
      JSON.stringify(method) === JSON.stringify(before.method);
    if (isSame || (before === null && method === null)) return;
    this.#wanted = method && { viewpoint, method };
    this.#movedAt = performance.now();
    this.#stop();
  }

  /** Gives up the view that is being read. The overview is shown again. */
  #stop(): void {
    this.#begun = null;
    this.#isEnded = false;
    this.#reader.stop();
    if (this.#isDetailShown) this.onDetail(null);
    this.#isDetailShown = false;
  }

  #begin(view: StreamView): void {
    this.#begun = view;
    const asked = performance.now();
    let last: StreamStep | null = null;
    const show = async (step: StreamStep, isLast: boolean) => {
      try {
        await this.#show(view, step, isLast, asked);
        if (this.#begun !== view) return;
        if (isLast) this.#isEnded = true;
        else this.#reader.next();
      } catch (error) {
        this.#refuse(view, error);
      }
    };
    this.#reader.view(view, {
      onStep: (step) => {
        last = step;
        const isBetter = step.positions.length / 3 >= this.#count && performance.now() >= this.#notBefore;
        if (step.exact || isBetter) void show(step, step.exact);
        else this.#reader.next();
      },
      onEnd: () => {
        if (last && !last.exact) void show(last, true);
      },
      onProblem: (error) => this.#refuse(view, error),
    });
  }

  async #show(view: StreamView, step: StreamStep, isLast: boolean, asked: number): Promise<void> {
    const begun = performance.now();
    const question = viewOf(view.viewpoint, overviewSettings(this.#settings!));
    const detail = await detailOf(step, view.viewpoint, this.#overview, this, {
      kind: step.exact ? "operator" : "part",
      asked,
      question,
      total: this.#total,
      sentence: sentenceOfStep(step, this.#total, isLast),
    });
    if (this.#begun !== view) {
      detail.inquiry.dispose();
      return;
    }
    // While another file is being opened, nothing can be shown. If that fails, the view begins again.
    this.#isDetailShown = this.onDetail(detail);
    if (!this.#isDetailShown) {
      detail.inquiry.dispose();
      this.#stop();
      return;
    }
    this.#count = detail.cloud.count;
    const now = performance.now();
    this.#notBefore = now + Math.max(CALM.least, CALM.times * (now - begun));
  }

  #refuse(view: StreamView, error: unknown): void {
    if (this.#begun !== view) return;
    this.#reader.stop();
    this.#isEnded = true;
    this.onError(error);
  }
}

/** The overview is asked once by one hull: the octree is read sooner, and its answer replaces this one. */
function overviewSettings(settings: Settings): Settings {
  return streamMethodOf(settings) === null ? settings : { ...settings, looks: 0 };
}
