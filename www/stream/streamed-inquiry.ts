import type { Settings, Viewpoint } from "../settings/settings.ts";
import type { MergeOptions } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import type { Cloud, Streamed } from "../cloud/cloud.ts";
import { spacingOf } from "../cloud/prepare.ts";
import { type Detail, Inquiry, isSamePlace, methodOf, type TimedView } from "../view/inquiry.ts";
import { CloudPoints } from "../view/points.ts";
import { THEMES } from "../view/theme.ts";
import { LoadProblem } from "../loaders/protocol.ts";

/** How a streamed octree is seen. */
export type StreamMethod = "automatic" | { length: number } | { exponential: number | "auto" };

/** The viewpoint and the method of one view of an octree. */
export interface StreamView {
  viewpoint: Viewpoint;
  method: StreamMethod;
}

/** What the page tells the worker. A view gives up the view before it. */
export type StreamTold =
  | { kind: "open"; streamed: Streamed }
  | { kind: "view"; turn: number; view: StreamView }
  | { kind: "next" }
  | { kind: "stop" };

/** What is known of a view so far. */
export interface StreamStep {
  /** x, y, z of all visible points of the nodes that were read. */
  positions: Float64Array<ArrayBuffer>;
  /** Red, green and blue of these points, in bytes. Null if the file has no colors. */
  colors: Uint8Array<ArrayBuffer> | null;
  exact: boolean;
  /** The numbers of nodes. */
  nodes: { read: number; hidden: number; undecided: number };
  /** The number of points that were read. */
  points: number;
  /** With it, all these points together have the same answer. */
  merge: MergeOptions;
}

/** What the worker answers. After each step it waits for `next`. */
export type StreamReply =
  | { kind: "step"; turn: number; step: StreamStep }
  | { kind: "end"; turn: number }
  | { kind: "problem"; turn: number; sentence: string };

/** What happens to a view. A step is followed by another one only after `next`. */
export interface ViewEvents {
  onStep: (step: StreamStep) => void;
  onEnd: () => void;
  onProblem: (error: LoadProblem) => void;
}

/** Reads an octree in its own worker, for one view at a time. */
export class OctreeReader {
  readonly #worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  #turn = 0;
  #events: ViewEvents | null = null;

  constructor(streamed: Streamed) {
    this.#worker.onmessage = ({ data: reply }: MessageEvent<StreamReply>) => {
      if (reply.turn !== this.#turn || !this.#events) return;
      const { onStep, onEnd, onProblem } = this.#events;
      if (reply.kind === "step") onStep(reply.step);
      else if (reply.kind === "end") onEnd();
      else onProblem(new LoadProblem(reply.sentence));
    };
    this.#worker.onerror = (event) => {
      event.preventDefault();
      const why = "a part of this page could not be loaded, or the browser ran out of memory";
      this.#events?.onProblem(new LoadProblem(`${streamed.name} could not be read further: ${why}.`));
    };
    this.#tell({ kind: "open", streamed });
  }

  /** Begins a view, and gives up the one before. */
  view(view: StreamView, events: ViewEvents): void {
    this.#events = events;
    this.#tell({ kind: "view", turn: ++this.#turn, view });
  }

  next(): void {
    this.#tell({ kind: "next" });
  }

  stop(): void {
    if (!this.#events) return;
    this.#events = null;
    this.#tell({ kind: "stop" });
  }

  dispose(): void {
    this.#events = null;
    this.#worker.terminate();
  }

  #tell(told: StreamTold): void {
    this.#worker.postMessage(told);
  }
}

/**
 * How a streamed octree is seen with these settings. `null`: they need all points at once. The automatic radius
 * and looks do, too. For them, the automatic exponential inversion is used.
 */
export function streamMethodOf({ radius, inversion }: Settings): StreamMethod | null {
  if (inversion !== "spherical") return inversion;
  if ("length" in radius) return { length: radius.length };
  return "rule" in radius ? "automatic" : null;
}

const number = new Intl.NumberFormat("en-US");
const counted = (count: number, one: string, more = `${one}s`) => `${number.format(count)} ${count === 1 ? one : more}`;

/** A step in words. `isLast`: whether no more nodes will be read. */
export function sentenceOfStep(
  { positions, exact, nodes, points }: StreamStep,
  total: number,
  isLast: boolean,
): string {
  const count = positions.length / 3;
  const seen = `${number.format(count)} of ${counted(total, "point")} can be seen from here`;
  const read = `${counted(nodes.read, "node")} with ${counted(points, "point")} ${nodes.read === 1 ? "was" : "were"} read`;
  const hidden = `${number.format(nodes.hidden)} more ${nodes.hidden === 1 ? "is" : "are"} hidden`;
  if (exact) return `${seen}, exactly: ${read}, ${hidden}.`;
  if (isLast) {
    return `${seen}: not exact, ${counted(nodes.undecided, "node")} undecided, since there is no room for more; ${read}, ${hidden}.`;
  }
  return `${seen} so far: ${read}, ${hidden}.`;
}

/** The answer about the overview in words. */
export function sentenceOfOverview(count: number, shown: number, total: number): string {
  return `${number.format(count)} of the ${counted(shown, "point")} of the coarser levels can be seen from here; the file has ${counted(total, "point")}.`;
}

/** Why only the overview answers. */
export const ONLY_OVERVIEW =
  "This answer is about the coarser levels alone. The other levels are read only without an exponent.";

/** The overview's inquiry: it notes when the camera or the settings have changed. */
type Leader = Pick<Inquiry, "follow" | "busy">;

type Said = Pick<TimedView, "kind" | "asked" | "question"> & NonNullable<TimedView["whole"]>;

/** Asks once about the points of a view, and answers the tools' questions. The picture's later questions go to the overview. */
class DetailInquiry extends Inquiry {
  readonly #leader: Leader;
  readonly #said: Said;

  constructor(
    cloud: WorkerPointCloud,
    another: () => Promise<WorkerPointCloud>,
    points: CloudPoints,
    leader: Leader,
    merge: MergeOptions,
    said: Said,
  ) {
    super(cloud, another, points);
    this.#leader = leader;
    this.#said = said;
    this.filter.setOptions({ ...merge, settle: false });
  }

  override get busy(): boolean {
    return this.#leader.busy;
  }

  override follow(viewpoint: Viewpoint, settings: Settings): void {
    this.filter.frozen = this.answer !== null;
    this.look(viewpoint);
    if (this.filter.frozen) this.#leader.follow(viewpoint, settings);
  }

  protected override told(view: TimedView): TimedView {
    const { total, sentence, ...said } = this.#said;
    return { ...view, ...said, whole: { total, sentence }, milliseconds: performance.now() - said.asked };
  }
}

/** Makes a cloud of the points of a step. All of them are visible together, as they are in the whole octree. */
export async function detailOf(
  { positions, colors, exact, points, merge }: StreamStep,
  viewpoint: Viewpoint,
  overview: Cloud,
  leader: Leader,
  settings: Settings,
  said: Said,
): Promise<Detail> {
  const { center, size, radius, body, facts } = overview;
  const [x, y, z] = body?.size ?? size;
  const local = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i++) local[i] = positions[i]! - center[i % 3]!;
  const cloud: Cloud = {
    count: positions.length / 3,
    colors,
    attributes: [],
    fields: [],
    // These points are not those of the file's records.
    facts: { ...(facts.decimals && { decimals: facts.decimals }), ...(facts.crs && { crs: facts.crs }) },
    origin: null,
    center,
    local,
    size,
    radius,
    body,
    spacing: spacingOf(local, Math.sqrt((2 * (x * y + y * z + z * x)) / (exact ? said.total : points))),
  };
  const made = () => WorkerPointCloud.create(positions, { workers: 1 });
  const drawn = new CloudPoints(cloud, THEMES.dark);
  const inquiry = new DetailInquiry(await made(), made, drawn, leader, merge, said);
  try {
    return { points: drawn, positions, inquiry, answer: await inquiry.first(viewpoint, settings) };
  } catch (error) {
    inquiry.dispose();
    throw error;
  }
}

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

  constructor(
    cloud: WorkerPointCloud,
    another: () => Promise<WorkerPointCloud>,
    points: CloudPoints,
    streamed: Streamed,
  ) {
    super(cloud, another, points);
    this.#overview = points.cloud;
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
    const settings = this.#settings!;
    const question = { viewpoint: view.viewpoint, method: methodOf(overviewSettings(settings)) };
    const detail = await detailOf(step, view.viewpoint, this.#overview, this, settings, {
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
    this.#count = detail.points.cloud.count;
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
