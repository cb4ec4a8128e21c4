import { byId } from "./panel/dom.ts";
import type { Answer } from "./refilter.ts";

/** The sentence changes not more often than this, in milliseconds, and is announced when it has stood for this long. */
const CALM = 800;
const SETTLED = 1000;

const number = new Intl.NumberFormat("en-US");

/**
 * The #status line: its data-attributes tell at once and in full precision, its sentence in calm and rounded. Screen
 * readers hear of a new sentence once the movement that changes it has stopped.
 */
export class Status {
  private readonly element: HTMLElement;
  private readonly announcement = byId("announcement");
  private sentence = "";
  private timer: ReturnType<typeof setTimeout> | undefined;
  private announcing: ReturnType<typeof setTimeout> | undefined;
  private refilters = 0;
  private last: (Pick<Answer, "visibility" | "milliseconds"> & { total: number }) | null = null;
  /** Answers to what was asked before this moment do not end a "loading" or an "error". */
  private since = Infinity;

  constructor(element: HTMLElement) {
    this.element = element;
  }

  /** Until `loaded` or `error`, whatever the cloud that is still there has to answer. */
  loading(sentence: string): void {
    this.since = Infinity;
    this.element.dataset["state"] = "loading";
    this.say(sentence);
  }

  loaded(): void {
    this.since = 0;
    this.interrupt();
  }

  /** The attributes of the cloud that is still there stay, and its next question makes it "ready" again. */
  error(sentence: string): void {
    this.since = performance.now();
    this.element.dataset["state"] = "error";
    this.interrupt();
    this.say(sentence);
  }

  /** All attributes are those of this one answer. */
  answer({ question, visibility, asked, milliseconds }: Answer, total: number, frozen: boolean): void {
    this.refilters++;
    Object.assign(this.element.dataset, {
      total: String(total),
      visible: String(visibility.count),
      viewpoint: question.viewpoint.map(String).join(","),
      radius: String(visibility.radius),
      exponent: String(visibility.exponent),
      milliseconds: String(milliseconds),
      refilters: String(this.refilters),
    });
    if (asked < this.since) return;
    this.element.dataset["state"] = "ready";
    this.last = { visibility, milliseconds, total };
    this.describe(frozen);
  }

  /** The sentence about the last answer, once more with what has become of the viewpoint. */
  describe(frozen: boolean): void {
    if (!this.last || this.element.dataset["state"] !== "ready") return;
    const { visibility, milliseconds, total } = this.last;
    const where = frozen ? "were visible from the frozen viewpoint" : "are visible from here";
    const time = milliseconds < 10 ? milliseconds.toFixed(1) : number.format(Math.round(milliseconds));
    const share = percent(visibility.count, total);
    this.say(`${number.format(visibility.count)} of ${number.format(total)} points (${share}) ${where}, found in ${time}\u00a0ms.`);
  }

  /** Lets the next sentence be read at once. */
  private interrupt(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
  }

  private say(sentence: string): void {
    this.sentence = sentence;
    clearTimeout(this.announcing);
    this.announcing = setTimeout(() => {
      this.announcement.textContent = sentence;
    }, SETTLED);
    if (this.timer !== undefined) return;
    this.element.textContent = sentence;
    this.timer = setTimeout(() => {
      this.timer = undefined;
      this.element.textContent = this.sentence;
    }, CALM);
  }
}

/** Rounded, but neither to none nor to all where that is not so. */
function percent(count: number, total: number): string {
  const share = total > 0 ? Math.round((100 * count) / total) : 0;
  if (share === 0 && count > 0) return "<\u00a01\u00a0%";
  if (share === 100 && count < total) return ">\u00a099\u00a0%";
  return `${share}\u00a0%`;
}
