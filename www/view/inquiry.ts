import {
  HprError,
  type Inversion as LibraryInversion,
  type Visibility,
  type VisibilityOptions,
} from "hidden-point-removal";
import { type FilterChange, HiddenPointFilter } from "hidden-point-removal/three";
import type { WorkerPointCloud } from "hidden-point-removal/worker";
import { PerspectiveCamera } from "three";
import {
  canLook,
  type Inversion,
  type Looks,
  type Radius,
  type Settings,
  type SurfaceChoice,
  type Viewpoint,
} from "../settings/settings.ts";
import type { CloudPoints } from "./points.ts";
import type { Cloud } from "../cloud/cloud.ts";

/** The part of a cloud that is looked at. A point outside is neither seen nor hides anything. */
export type Selection = Pick<Settings, "box" | "without">;

/** 1 for each point of other classes than those that are left out. Undefined: all points. */
export function classMask(cloud: Cloud, { without }: Selection): Uint8Array | undefined {
  const column = without && cloud.attributes.find(({ name }) => name === without.column);
  if (!column) return undefined;
  const left = new Set(without.values);
  return Uint8Array.from(column.values, (value) => Number(!left.has(value)));
}

/** 1 for each point that takes part. Null: all points do. */
export function partMask(cloud: Cloud, positions: Float32Array | Float64Array, part: Selection): Uint8Array | null {
  const mask = classMask(cloud, part);
  const { box } = part;
  if (!box) return mask ?? null;
  const all = mask ?? new Uint8Array(cloud.count).fill(1);
  const [low, high] = box;
  for (let i = 0; i < positions.length; i++) {
    const [value, axis] = [positions[i]!, i % 3];
    if (value < low[axis]! || value > high[axis]!) all[(i - axis) / 3] = 0;
  }
  return all;
}

/** How the library decides which points a viewpoint sees. */
export interface Method {
  /** Only for the spherical flip; `null` for the others, and with looks. */
  radius: Radius | null;
  inversion: Inversion;
  /** 0: the operator of the paper. */
  looks: Looks;
  /** Only with looks. Undefined: it follows from the noise of the cloud. */
  thickness?: number | undefined;
  /** Only with looks. Undefined: what the library finds. */
  surface?: Exclude<SurfaceChoice, "auto"> | undefined;
  /** Undefined: all points take part. */
  part?: Selection | undefined;
}

/** The question of what can be seen. */
export interface ViewQuestion {
  viewpoint: Viewpoint;
  method: Method;
}

/** An answer for the picture, with its question. */
export interface TimedView {
  question: ViewQuestion;
  visibility: Visibility;
  /** Why the library refused the settings, if its defaults were used instead. */
  note: string | null;
  kind: "operator" | "looks";
  /** The time of the question (performance.now), and how long the answer took. */
  asked: number;
  milliseconds: number;
}

/** A map that is drawn, of this viewpoint. */
export type Mapped = Pick<ViewQuestion, "viewpoint"> & Pick<TimedView, "milliseconds">;

/** The operator of the paper with these settings. */
export function operatorOf({ radius, inversion, box, without }: Settings): Method {
  const part = box || without ? { part: { box, without } } : {};
  return { radius: inversion === "spherical" ? radius : null, inversion, looks: 0, ...part };
}

/** How the final answer is found with these settings. */
export function methodOf(settings: Settings): Method {
  const { looks, thickness, surface } = settings;
  const method = operatorOf(settings);
  return looks > 0 && canLook(settings)
    ? {
        ...method,
        radius: null,
        looks,
        ...(thickness !== "auto" && { thickness }),
        ...(surface !== "auto" && { surface }),
      }
    : method;
}

/**
 * Orbit controls change the viewpoint by a few bits even if nothing has moved. So a move by less than this share of the
 * cloud's size does not count.
 */
const SAME = 1e-9;

export function isSamePlace(a: Viewpoint, b: Viewpoint, size: number): boolean {
  return a.every((value, axis) => Math.abs(value - b[axis]!) <= SAME * size);
}

/** A cloud with the filter that draws what a viewpoint sees of it. */
export class Inquiry {
  onView: (answer: TimedView) => void = () => undefined;
  /** A map stands in for the answer, until the viewpoint rests. */
  onMap: (mapped: Mapped) => void = () => undefined;
  onError: (error: unknown) => void = () => undefined;

  /** The cloud in its worker, also for questions that are not for the picture. */
  cloud: WorkerPointCloud;
  /** The last answer. */
  answer: TimedView | null = null;
  readonly filter: HiddenPointFilter;
  /** The filter gets the viewpoint itself: it may be frozen, and is exactly the place that was asked for. */
  readonly #camera = new PerspectiveCamera();
  readonly #points: CloudPoints;
  readonly #positions: Float32Array | Float64Array;
  #part: { text: string; classes: Uint8Array | undefined; mask: Uint8Array | null } | null = null;
  /** That of the filter's own options. */
  #method: Method = { radius: null, inversion: "spherical", looks: 3 };
  #viewpoint: Viewpoint = [0, 0, 0];
  /** Why the library's defaults are asked instead of the settings, and where these were refused. */
  #refused: { note: string; at: Viewpoint } | null = null;

  /** `another` makes a lost cloud again. */
  constructor(
    cloud: WorkerPointCloud,
    another: () => Promise<WorkerPointCloud>,
    points: CloudPoints,
    positions: Float32Array | Float64Array,
  ) {
    this.cloud = cloud;
    this.#points = points;
    this.#positions = positions;
    let isFirst = true;
    this.filter = new HiddenPointFilter(points.solid, {
      cloud: async () => {
        if (!isFirst) this.cloud = await another().catch(lost);
        isFirst = false;
        return this.cloud;
      },
      origin: points.cloud.center,
      dimMaterial: points.ghost,
    });
    this.filter.addEventListener("change", (change) => this.#take(change));
    this.filter.addEventListener("error", ({ error }) => this.#refuse(error));
  }

  /** Whether an answer for the last viewpoint and settings is still to come. */
  get busy(): boolean {
    return !this.filter.settled;
  }

  /** Returns the first answer. Nothing is shown before it. */
  first(viewpoint: Viewpoint, settings: Settings): Promise<TimedView> {
    return new Promise((resolve, reject) => {
      this.onView = resolve;
      this.onError = reject;
      this.follow(viewpoint, settings);
    });
  }

  /** Called every frame and after every change. Asks if the viewpoint or the settings are new. */
  follow(viewpoint: Viewpoint, settings: Settings): void {
    const method = methodOf(settings);
    this.#viewpoint = viewpoint;
    const isOther = JSON.stringify(method) !== JSON.stringify(this.#method);
    // Settings that do not suit one place may suit another one.
    const isElsewhere =
      this.#refused !== null && !this.busy && !isSamePlace(viewpoint, this.#refused.at, this.#points.cloud.radius);
    if (isOther || isElsewhere) this.#set(method);
    this.filter.update(this.#camera, viewpoint);
  }

  /** Asks a question that is not for the picture. */
  aside({ viewpoint, method }: ViewQuestion): Promise<Visibility> {
    return this.cloud.visibleFrom(viewpoint, this.options(method));
  }

  /** What the library is asked for. */
  options({ radius, inversion, looks, thickness, surface, part }: Method): VisibilityOptions {
    return {
      ...(radius === null
        ? {}
        : "rule" in radius
          ? { radius: radius.rule }
          : "length" in radius
            ? { radius: radius.length }
            : radius),
      ...(inversion === "spherical" ? {} : { inversion: this.#inversion(inversion) }),
      ...(looks === 0 ? {} : { looks, thickness, surface }),
      ...this.#within(part),
    } as unknown as VisibilityOptions;
  }

  /** 1 for each point that takes part. Null: all points do. */
  maskOf(part: Selection): Uint8Array | null {
    return this.#masksOf(part).mask;
  }

  #masksOf({ box, without }: Selection) {
    const text = JSON.stringify([box, without]);
    if (this.#part?.text === text) return this.#part;
    const { cloud } = this.#points;
    const part = { box, without };
    return (this.#part = { text, classes: classMask(cloud, part), mask: partMask(cloud, this.#positions, part) });
  }

  #within(part: Selection | undefined): Pick<VisibilityOptions, "within"> {
    if (!part) return {};
    const { classes: mask } = this.#masksOf(part);
    return { within: { ...(part.box && { box: part.box }), ...(mask && { mask }) } };
  }

  dispose(): void {
    this.onMap = this.onView = this.onError = () => undefined;
    this.filter.dispose();
    void this.cloud.dispose();
  }

  #inversion({ exponential }: Exclude<Method["inversion"], "spherical">): LibraryInversion {
    return { exponential: exponential === "auto" ? "auto" : exponential * this.cloud.spacing };
  }

  #set(method: Method): void {
    this.#method = method;
    this.#refused = null;
    const options = this.options(method);
    try {
      this.filter.setOptions(method.looks > 0 ? { settle: options } : { ...options, settle: false });
    } catch (error) {
      this.#refuse(error);
    }
  }

  #take({ visibility, viewpoint, milliseconds, answer: kind }: FilterChange): void {
    const at = viewpoint as Viewpoint;
    if (visibility === null) {
      this.onMap({ viewpoint: at, milliseconds });
      return;
    }
    const method = this.#method;
    const hull: Method = { ...method, radius: { rule: "auto" }, looks: 0, thickness: undefined, surface: undefined };
    const question = { viewpoint: at, method: method.looks > 0 && kind === "operator" ? hull : method };
    const [asked, note] = [performance.now() - milliseconds, this.#refused?.note ?? null];
    this.answer = { question, visibility, note, kind: kind as TimedView["kind"], asked, milliseconds };
    this.onView(this.answer);
  }

  /** If the settings do not suit the cloud or the place, the library's defaults are used. */
  #refuse(error: unknown): void {
    const isUnsuited = error instanceof HprError && (error.code === "radius" || error.code === "option");
    if (!isUnsuited || this.#refused !== null) {
      this.onError(error);
      return;
    }
    const why = error.message.replace(/\.$/, "");
    const note = `These settings do not suit this cloud or place, so the usual ones are used: ${why}.`;
    this.#refused = { note, at: this.#viewpoint };
    this.filter.setOptions({ ...this.#within(this.#method.part), settle: false });
  }
}

/** For the filter, a cloud that cannot be made again is lost, too. */
function lost(cause: unknown): never {
  throw new HprError("internal", cause instanceof Error ? cause.message : String(cause), { cause });
}

/** Whether a worker has given no sign of life for too long. */
export function isHang(error: unknown): boolean {
  const cause = error instanceof HprError && error.cause;
  return cause instanceof DOMException && cause.name === "TimeoutError";
}

const number = new Intl.NumberFormat("en-US");

/** An answer in words, for everybody and for screen readers. */
export function sentenceOf({ visibility }: TimedView, total: number, frozen: boolean): string {
  const points = total === 1 ? "point" : "points";
  const where = frozen ? "the frozen viewpoint" : "here";
  return `${number.format(visibility.count)} of ${number.format(total)} ${points} can be seen from ${where}.`;
}

/** The same in round numbers, to be read at a glance. */
export function captionOf({ visibility }: TimedView, total: number, frozen: boolean): string {
  const points = total === 1 ? "point" : "points";
  const seen = `can be seen from ${frozen ? "the eye" : "here"}`;
  return `${rounded(total)} ${points}. ${rounded(visibility.count)} ${seen}.`;
}

/** Two digits of a large number. A small one is told exactly. */
function rounded(count: number): string {
  return number.format(count < 10_000 ? count : Number(count.toPrecision(2)));
}
