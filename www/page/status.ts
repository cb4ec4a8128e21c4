import type { Inversion } from "../settings/settings.ts";
import { SETTINGS } from "../settings/table.ts";
import { captionOf, type Mapped, sentenceOf, type TimedView } from "../view/inquiry.ts";
import { byId } from "../controls/controls.ts";
import type { WorkerPointCloud } from "hidden-point-removal/worker";
import type { Cloud } from "../cloud/cloud.ts";
import type { Settings } from "../settings/settings.ts";
import { measured, measuresOf } from "../tools/make.ts";

const SURFACES = {
  clean: "A clean surface",
  noisy: "A noisy scan; its noise is removed before the looks",
  layered: "A layered scan",
};
/** The thickness of layers in standard deviations of noise, beyond what clean clouds have, in spacings. */
const LAYERS = 14;
const CLEAN = 0.075;

/** Milliseconds between two changes of the sentence. A sentence that stays for this time is announced. */
const CALM = 800;
const SETTLED = 1000;

/**
 * The #status line. Its data-attributes change at once and have full precision. Its sentence changes less often and has
 * rounded numbers. Screen readers hear a new sentence when the movement that changes it has stopped.
 */
export class Status {
  readonly #element: HTMLElement;
  readonly #announcement = byId("announcement");
  /** The sentence over the picture. Screen readers have the status. */
  readonly #caption = byId("caption");
  #sentence = "";
  #captioned = "";
  /** The caption of the last answer. */
  #answered = "";
  #timer: ReturnType<typeof setTimeout> | undefined;
  #announcing: ReturnType<typeof setTimeout> | undefined;
  #refilters = 0;
  #last: (TimedView & { total: number }) | null = null;
  /** Answers to questions from before this moment do not end a "loading" or an "error". */
  #since = Infinity;

  constructor(element: HTMLElement) {
    this.#element = element;
  }

  /** Shows "loading" until `loaded` or `error`. Answers about the cloud that is still on screen do not change it. */
  loading(sentence: string): void {
    this.#since = Infinity;
    this.#element.dataset["state"] = "loading";
    this.busy(true);
    this.#say(sentence);
  }

  loaded(): void {
    this.#since = 0;
    this.#interrupt();
  }

  /**
   * Shows an error. The attributes of the cloud on screen stay. The answer to the next question is "ready" again. The
   * message says it over the picture: a long caption would cover more of the picture, which would ask for another view.
   */
  error(sentence: string): void {
    this.#since = performance.now();
    this.#element.dataset["state"] = "error";
    this.busy(false);
    this.#interrupt();
    this.#say(sentence, this.#answered);
  }

  /** Whether an answer for the present settings and place is still to come. */
  busy(busy: boolean): void {
    this.#element.dataset["busy"] = busy ? "1" : "0";
  }

  /** Sets all attributes from this one answer. */
  answer(answer: TimedView, total: number, frozen: boolean): void {
    const { question, kind, visibility, asked, milliseconds } = answer;
    this.#refilters++;
    Object.assign(this.#element.dataset, {
      answer: kind,
      total: String(total),
      visible: String(visibility.count),
      viewpoint: String(question.viewpoint),
      radius: String(visibility.radius),
      exponent: String(visibility.exponent),
      evaluations: String(visibility.evaluations),
      inversion: inversionText(visibility.inversion),
      milliseconds: String(milliseconds),
      refilters: String(this.#refilters),
    });
    // Looks only improve the answer to a view. After an error, a new question begins with another answer.
    const isError = this.#element.dataset["state"] === "error";
    if (asked < this.#since || (isError && kind === "looks")) return;
    this.#element.dataset["state"] = "ready";
    this.#last = { ...answer, total };
    this.describe(frozen);
  }

  /** Says what looks take the cloud to be, in `data-surface` and in one line. */
  async surface(points: WorkerPointCloud, cloud: Cloud, settings: () => Settings): Promise<void> {
    const [found, noise] = await Promise.all([points.surface, points.noise]);
    const { surface, thickness } = settings();
    const kind = surface === "auto" ? found : surface;
    const { unit } = measuresOf(cloud);
    // docs/LOOKS.md, "Layered".
    const depth = thickness === "auto" ? LAYERS * (noise - CLEAN * points.spacing) : thickness;
    const about = measured(Number(depth.toPrecision(1)), unit);
    const behind = kind === "layered" && depth > 0 ? `; points up to about ${about} behind a surface are shown` : "";
    this.#element.dataset["surface"] = kind;
    for (const line of document.querySelectorAll(".found")) line.textContent = `${SURFACES[kind]}${behind}.`;
  }

  /** A map is drawn. The numbers of the last answer stay. Its sentence is not announced: the movement has not stopped. */
  map({ viewpoint, milliseconds }: Mapped): void {
    if (this.#element.dataset["state"] === "ready") clearTimeout(this.#announcing);
    this.#refilters++;
    Object.assign(this.#element.dataset, {
      answer: "map",
      viewpoint: String(viewpoint),
      milliseconds: String(milliseconds),
      refilters: String(this.#refilters),
    });
  }

  /** Says the last answer again, since the viewpoint may have been frozen or not. */
  describe(frozen: boolean): void {
    if (!this.#last || this.#element.dataset["state"] !== "ready") return;
    const { total } = this.#last;
    this.#answered = captionOf(this.#last, total, frozen);
    this.#say(sentenceOf(this.#last, total, frozen), this.#answered);
  }

  /** Lets the next sentence be read at once. */
  #interrupt(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }

  #say(sentence: string, caption = sentence): void {
    this.#sentence = sentence;
    this.#captioned = caption;
    clearTimeout(this.#announcing);
    this.#announcing = setTimeout(() => (this.#announcement.textContent = sentence), SETTLED);
    if (this.#timer !== undefined) return;
    this.#write();
    this.#timer = setTimeout(() => {
      this.#timer = undefined;
      this.#write();
    }, CALM);
  }

  #write(): void {
    this.#element.textContent = this.#sentence;
    this.#caption.textContent = this.#captioned;
  }
}

function inversionText(inversion: TimedView["visibility"]["inversion"]): string {
  return typeof inversion === "object" && "looks" in inversion
    ? `looks:${inversion.looks.join()}`
    : SETTINGS.inversion.write(inversion as Inversion);
}
