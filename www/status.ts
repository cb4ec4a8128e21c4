import type { Answer } from "./refilter.ts";

/** Screen readers read the sentence anew each time it changes: not more often than this, in milliseconds. */
const QUIET = 800;

const number = new Intl.NumberFormat("en-US");

/** The #status line: its data-attributes tell at once and in full precision, its sentence in calm and rounded. */
export class Status {
  private readonly element: HTMLElement;
  private sentence = "";
  private timer: ReturnType<typeof setTimeout> | null = null;
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
    const share = total > 0 ? Math.round((100 * visibility.count) / total) : 0;
    const where = frozen ? "were visible from the frozen viewpoint" : "are visible from here";
    const effort = `found in ${milliseconds < 10 ? milliseconds.toFixed(1) : number.format(Math.round(milliseconds))} ms`;
    this.say(`${number.format(visibility.count)} of ${number.format(total)} points (${share} %) ${where}, ${effort}.`);
  }

  /** Lets the next sentence be heard at once. */
  private interrupt(): void {
    if (this.timer !== null) clearTimeout(this.timer);
    this.timer = null;
  }

  private say(sentence: string): void {
    this.sentence = sentence;
    if (this.timer !== null) return;
    this.element.textContent = sentence;
    this.timer = setTimeout(() => {
      this.timer = null;
      if (this.element.textContent !== this.sentence) this.say(this.sentence);
    }, QUIET);
  }
}
