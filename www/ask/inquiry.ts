import type { Settings, Viewpoint } from "../settings/settings.ts";
import { askLight, type LightAnswer } from "./lights.ts";
import { Newest } from "./newest.ts";
import {
  isAutomatic,
  isSlow,
  isSameLight,
  isSamePlace,
  isSameView,
  type LightQuestion,
  type Method,
  methodOf,
  quickLight,
  quickView,
  shapeOf,
  type ViewQuestion,
} from "./question.ts";
import { SecondCloud } from "./second-cloud.ts";
import { askView, type ViewAnswer } from "./views.ts";
import type { WorkerCloud } from "./worker-cloud.ts";

export interface TimedView extends ViewAnswer {
  /** Whether it only stands in, while something moves, for a slower one. */
  quick: boolean;
  /** When it was asked (performance.now), and how long it took once it had its turn. */
  asked: number;
  milliseconds: number;
}

/** What has not moved for so many milliseconds is at rest. */
const REST = 250;

/** Keeps the answers up with the viewpoint and the settings: what is seen, and how it is lit. Each is asked anew only when something it depends on has changed. */
export class Inquiry {
  onView: (answer: TimedView) => void = () => undefined;
  /** `null`: there are no lights. */
  onLight: (answer: LightAnswer | null) => void = () => undefined;
  /** The exponent that the automatic radius has where the viewpoint rests. */
  onAutomatic: (exponent: number) => void = () => undefined;
  onError: (error: unknown) => void = () => undefined;

  readonly #cloud: WorkerCloud;
  readonly #second: SecondCloud;
  readonly #size: number;
  readonly #views = new Newest<ViewQuestion>((question, overtaken) => this.#view(question, overtaken));
  readonly #lights = new Newest<LightQuestion>((question, overtaken) => this.#light(question, overtaken));
  #wanted: { view: ViewQuestion | null; light: LightQuestion | null } = { view: null, light: null };
  #answered: { view: ViewQuestion | null; light: LightQuestion | null } = { view: null, light: null };
  #mesh: Uint32Array | null = null;
  #viewpoint: { at: Viewpoint; since: number } | null = null;
  #lamps: { at: Settings["lights"]; since: number } | null = null;
  #freeSince = 0;
  #upToDate = false;

  /** `another` makes the same cloud once more, for what takes long. */
  constructor(cloud: WorkerCloud, another: () => Promise<WorkerCloud>, size: number) {
    this.#cloud = cloud;
    this.#second = new SecondCloud(another);
    this.#size = size;
  }

  /** Whether an answer to what was last followed is still to come. */
  get busy(): boolean {
    return !this.#upToDate;
  }

  /** The first answer, before anything is shown. */
  async first(viewpoint: Viewpoint, settings: Settings): Promise<TimedView> {
    const question = { viewpoint, method: methodOf(settings), shape: shapeOf(settings) };
    this.#wanted.view = question;
    this.#viewpoint = { at: viewpoint, since: -Infinity };
    return this.#ask(this.#cloud, undefined, question);
  }

  /** Tells the automatic exponent where the answer itself does not, unless a newer question waits. */
  async findAutomatic(): Promise<void> {
    const question = this.#wanted.view;
    if (!question?.method.radius || isAutomatic(question.method)) return;
    const { exponent } = await this.#cloud.points.autoRadius(question.viewpoint);
    if (question === this.#wanted.view) this.onAutomatic(exponent);
  }

  /** Called every frame and after every change; does nothing while the questions stay the same. */
  follow(viewpoint: Viewpoint, settings: Settings): void {
    const now = performance.now();
    if (!this.#viewpoint || !isSamePlace(viewpoint, this.#viewpoint.at, this.#size))
      this.#viewpoint = { at: viewpoint, since: now };
    if (this.#lamps?.at !== settings.lights)
      this.#lamps = { at: settings.lights, since: this.#lamps ? now : -Infinity };
    const moving = now - this.#viewpoint.since < REST;

    const view: ViewQuestion = { viewpoint, method: methodOf(settings), shape: shapeOf(settings) };
    this.#wantView(moving ? quickView(view) : view);
    const { lights, soft, ambient, smoothing } = settings;
    const light: LightQuestion = { lights, soft, ambient, smoothing, method: view.method, mesh: this.#mesh };
    this.#wantLight(light, moving, now - this.#lamps.since < REST);

    this.#upToDate =
      this.#answered.view !== null &&
      isSameView(this.#answered.view, view, this.#size) &&
      (lights.length === 0 || (this.#answered.light !== null && isSameLight(this.#answered.light, light)));
  }

  /** An answer besides those for the picture, which go first. */
  async aside(question: ViewQuestion): Promise<ViewAnswer> {
    const answer = await askView(this.#cloud, question);
    this.#noteFree(this.#cloud);
    return answer;
  }

  /** The cloud's spacing in its own units; 0 where it has none. */
  get spacing(): number {
    return this.#cloud.points.spacing;
  }

  dispose(): void {
    this.onView = this.onLight = this.onAutomatic = this.onError = () => undefined;
    void this.#cloud.points.dispose();
    this.#second.dispose();
  }

  #wantView(question: ViewQuestion): void {
    if (this.#wanted.view && isSameView(question, this.#wanted.view, this.#size)) return;
    this.#wanted.view = question;
    this.#views.want(question);
  }

  #wantLight(question: LightQuestion, viewMoving: boolean, lightsMoving: boolean): void {
    const { light: last } = this.#wanted;
    if (question.lights.length === 0) {
      if (last) this.onLight(null);
      this.#wanted.light = this.#answered.light = null;
      return;
    }
    // Every point has its light, seen or not: while the surface moves under a light that does not, the last one serves.
    const asked = viewMoving && last ? { ...question, mesh: last.mesh } : question;
    const wanted = lightsMoving ? quickLight(asked) : asked;
    if (last && isSameLight(wanted, last)) return;
    this.#wanted.light = wanted;
    this.#lights.want(wanted);
  }

  async #view(question: ViewQuestion, overtaken: AbortSignal): Promise<void> {
    try {
      this.onView(await this.#ask(...(await this.#placeFor(question, overtaken)), question));
      if (question === this.#wanted.view) await this.findAutomatic();
    } catch (error) {
      if (isAbort(error)) return;
      this.onError(error);
    }
    // Also what was refused is not to be waited for.
    this.#answered.view = question;
  }

  async #light(question: LightQuestion, overtaken: AbortSignal): Promise<void> {
    try {
      const [cloud, signal] = await this.#placeFor(question, overtaken);
      const answer = await askLight(cloud, question, signal);
      this.#noteFree(cloud);
      if (this.#wanted.light) this.onLight(answer);
    } catch (error) {
      if (isAbort(error)) return;
      this.onError(error);
    }
    if (this.#wanted.light) this.#answered.light = question;
  }

  /** Where a question is asked, and what gives it up: an answer that comes soon is shown also where the camera has moved on. */
  async #placeFor(
    { method }: { method: Method },
    overtaken: AbortSignal,
  ): Promise<[WorkerCloud, AbortSignal | undefined]> {
    return isSlow(method) ? [await this.#second.ready(overtaken), overtaken] : [this.#cloud, undefined];
  }

  /** From now on the cloud in the foreground has time for the next question. */
  #noteFree(cloud: WorkerCloud): void {
    if (cloud === this.#cloud) this.#freeSince = performance.now();
  }

  async #ask(cloud: WorkerCloud, signal: AbortSignal | undefined, question: ViewQuestion): Promise<TimedView> {
    const asked = performance.now();
    const answer = await askView(cloud, question, signal);
    const begun = cloud === this.#cloud ? Math.max(asked, this.#freeSince) : asked;
    this.#noteFree(cloud);
    this.#mesh = answer.triangles;
    this.#answered.view = question;
    return { ...answer, quick: question.quick === true, asked, milliseconds: performance.now() - begun };
  }
}

/** Another question has come in the place of this one. */
function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}
