import { Follower, type Round } from "../../src/ts/follow/follower.ts";
import { Overtaken } from "../../src/ts/follow/overtaken.ts";
import { Rest } from "../../src/ts/follow/rest.ts";
import type { Settings, Viewpoint } from "../settings/settings.ts";
import { askLight, type LightAnswer } from "./lights.ts";
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
  /** Whether this is a quick answer in place of a slower one, because something moves. */
  quick: boolean;
  /** The time of the question (performance.now), and how long the answer took, without the time of waiting. */
  asked: number;
  milliseconds: number;
}

/** A viewpoint or a light that has not moved for this number of milliseconds is at rest. */
const REST = 250;

/**
 * Keeps the answers up to date with the viewpoint and the settings: which points are seen, and how they are lit. Each
 * question is asked again only if something that it depends on has changed.
 */
export class Inquiry {
  onView: (answer: TimedView) => void = () => undefined;
  /** `null`: there are no lights. */
  onLight: (answer: LightAnswer | null) => void = () => undefined;
  /** The exponent of the automatic radius at the viewpoint's last rest. */
  onAutomatic: (exponent: number) => void = () => undefined;
  onError: (error: unknown) => void = () => undefined;

  readonly #cloud: WorkerCloud;
  readonly #second: SecondCloud;
  readonly #size: number;
  readonly #views = new Overtaken<ViewQuestion>((a, b) => isSameView(a, b, this.#size));
  readonly #lights = new Overtaken<LightQuestion>(isSameLight);
  readonly #viewFollower = new Follower({
    next: () => (this.#views.isNew ? this.#viewRound() : undefined),
    refused: (error) => {
      // A question that was refused also counts as answered.
      this.#answered.view = this.#views.asked;
      this.onError(error);
    },
  });
  readonly #lightFollower = new Follower({
    next: () => (this.#lights.isNew ? this.#lightRound() : undefined),
    refused: (error) => {
      this.#answered.light = this.#lights.asked;
      this.onError(error);
    },
  });
  #answered: { view?: ViewQuestion | undefined; light?: LightQuestion | undefined } = {};
  #mesh: Uint32Array | null = null;
  #viewpoint: Viewpoint | null = null;
  readonly #viewpointRest = new Rest(REST);
  #lamps: Settings["lights"] | null = null;
  readonly #lampsRest = new Rest(REST);
  #freeSince = 0;
  #upToDate = false;

  /** `another` makes a second copy of the cloud, for slow questions. */
  constructor(cloud: WorkerCloud, another: () => Promise<WorkerCloud>, size: number) {
    this.#cloud = cloud;
    this.#second = new SecondCloud(another);
    this.#size = size;
  }

  /** Whether the last question still waits for its answer. */
  get busy(): boolean {
    return !this.#upToDate;
  }

  /** Returns the first answer. Nothing is shown before it. */
  async first(viewpoint: Viewpoint, settings: Settings): Promise<TimedView> {
    this.#viewpoint = viewpoint;
    this.#views.want({ viewpoint, method: methodOf(settings), shape: shapeOf(settings) });
    return this.#ask(this.#cloud, undefined, this.#views.take());
  }

  /** Finds the automatic exponent if the answer does not contain it. Does nothing if a newer question waits. */
  async findAutomatic(): Promise<void> {
    const question = this.#views.wanted;
    if (!question?.method.radius || isAutomatic(question.method)) return;
    const { exponent } = await this.#cloud.points.autoRadius(question.viewpoint);
    if (question === this.#views.wanted) this.onAutomatic(exponent);
  }

  /** Called every frame and after every change. Does nothing while the questions stay the same. */
  follow(viewpoint: Viewpoint, settings: Settings): void {
    if (!this.#viewpoint || !isSamePlace(viewpoint, this.#viewpoint, this.#size)) {
      this.#viewpoint = viewpoint;
      this.#viewpointRest.moved();
    }
    if (this.#lamps !== settings.lights) {
      // The first lights count as being at rest.
      if (this.#lamps) this.#lampsRest.moved();
      this.#lamps = settings.lights;
    }
    const moving = !this.#viewpointRest.isReached;

    const view: ViewQuestion = { viewpoint, method: methodOf(settings), shape: shapeOf(settings) };
    this.#wantView(moving ? quickView(view) : view);
    const { lights, soft, ambient, smoothing } = settings;
    const light: LightQuestion = { lights, soft, ambient, smoothing, method: view.method, mesh: this.#mesh };
    this.#wantLight(light, moving, !this.#lampsRest.isReached);

    const answered = this.#answered;
    this.#upToDate =
      answered.view !== undefined &&
      isSameView(answered.view, view, this.#size) &&
      (lights.length === 0 || (answered.light !== undefined && isSameLight(answered.light, light)));
  }

  /** Asks a question that is not for the picture. Questions for the picture go first. */
  async aside(question: ViewQuestion): Promise<ViewAnswer> {
    const answer = await askView(this.#cloud, question);
    this.#noteFree(this.#cloud);
    return answer;
  }

  /** The cloud's spacing in its own units. 0 if it has none. */
  get spacing(): number {
    return this.#cloud.points.spacing;
  }

  dispose(): void {
    this.onView = this.onLight = this.onAutomatic = this.onError = () => undefined;
    this.#viewFollower.stop();
    this.#lightFollower.stop();
    void this.#cloud.points.dispose();
    this.#second.dispose();
  }

  #wantView(question: ViewQuestion): void {
    this.#views.want(question);
    this.#viewFollower.follow();
  }

  #wantLight(question: LightQuestion, viewMoving: boolean, lightsMoving: boolean): void {
    const last = this.#lights.wanted;
    if (question.lights.length === 0) {
      if (last) this.onLight(null);
      this.#lights.clear();
      this.#answered.light = undefined;
      return;
    }
    // The light of a point does not depend on whether the point is seen. So while the view moves, the last mesh is
    // used.
    const asked = viewMoving && last ? { ...question, mesh: last.mesh } : question;
    this.#lights.want(lightsMoving ? quickLight(asked) : asked);
    this.#lightFollower.follow();
  }

  #viewRound(): Round {
    const question = this.#views.take();
    const overtaken = this.#views.signal;
    return {
      ask: async () => {
        this.onView(await this.#ask(...(await this.#placeFor(question, overtaken)), question));
        if (question === this.#views.wanted) await this.findAutomatic();
      },
      use: () => {
        this.#answered.view = question;
        return undefined;
      },
      isGivenUp: (error) => isGivenUp(error, this.#views),
    };
  }

  #lightRound(): Round<LightAnswer> {
    const question = this.#lights.take();
    const overtaken = this.#lights.signal;
    return {
      ask: async () => {
        const [cloud, signal] = await this.#placeFor(question, overtaken);
        const answer = await askLight(cloud, question, signal);
        this.#noteFree(cloud);
        return answer;
      },
      use: (answer) => {
        if (this.#lights.wanted) {
          this.onLight(answer);
          this.#answered.light = question;
        }
        return undefined;
      },
      isGivenUp: (error) => isGivenUp(error, this.#lights),
    };
  }

  /**
   * Returns the cloud that answers a question, and the signal that cancels the question. Only a slow question has a
   * signal. The answer to any other question is shown even if the camera has moved on.
   */
  async #placeFor(
    { method }: { method: Method },
    overtaken: AbortSignal,
  ): Promise<[WorkerCloud, AbortSignal | undefined]> {
    return isSlow(method) ? [await this.#second.ready(overtaken), overtaken] : [this.#cloud, undefined];
  }

  /** From now on, the cloud in the foreground can take the next question. */
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

/** Whether a newer question has cancelled this one. Then this one can be asked again. */
function isGivenUp(error: unknown, questions: { forget(): void }): boolean {
  const isAbort = error instanceof DOMException && error.name === "AbortError";
  if (isAbort) questions.forget();
  return isAbort;
}
