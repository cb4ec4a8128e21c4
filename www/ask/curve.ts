import { Rest } from "./rest.ts";
import type { Settings, Viewpoint } from "../settings/settings.ts";
import type { Inquiry } from "./inquiry.ts";
import { isSameView, operatorOf, type ViewQuestion } from "./question.ts";

/**
 * The exponents from the least radius to the end of the slider. Every second one comes first, so that the shape shows
 * soon.
 */
const EXPONENTS = [0, 2, 4, 6, 1, 3, 5, 0.5, 1.5, 2.5, 3.5, 4.5, 5.5];
/** The number of milliseconds for which the picture must be at rest. */
const REST = 400;

/**
 * Finds the number of visible points for one radius after another. Asks one question at a time, and only while no
 * other question is open.
 */
export class Curve {
  /** The number of visible points by exponent; NaN if the question failed. */
  readonly counts = new Map<number, number>();
  readonly #inquiry: Inquiry;
  readonly #size: number;
  #question: ViewQuestion | null = null;
  readonly #rest = new Rest(REST);
  #asking = false;

  constructor(inquiry: Inquiry, size: number) {
    this.#inquiry = inquiry;
    this.#size = size;
  }

  /** Called every frame while the curve is shown. Calls `changed` after each change of the curve. */
  follow(viewpoint: Viewpoint, settings: Settings, changed: () => void): void {
    const viewpoints = settings.show === "points" ? settings.viewpoints : "one";
    const question: ViewQuestion = {
      viewpoint,
      method: { ...operatorOf(settings), radius: null },
      shape: { kind: "points", viewpoints },
    };
    if (!this.#question || !isSameView(question, this.#question, this.#size)) {
      this.#question = question;
      this.counts.clear();
      this.#rest.moved();
      changed();
    }
    if (this.#inquiry.busy) this.#rest.moved();
    const next = EXPONENTS.find((exponent) => !this.counts.has(exponent));
    if (next === undefined || this.#asking || !this.#rest.isReached) return;
    this.#asking = true;
    void this.#ask(this.#question, next).then(() => {
      this.#asking = false;
      changed();
    });
  }

  async #ask(question: ViewQuestion, exponent: number): Promise<void> {
    let count = NaN;
    try {
      const { visibility, note } = await this.#inquiry.aside({
        ...question,
        method: { ...question.method, radius: { exponent } },
      });
      if (note === null) count = visibility.count;
    } catch {
      // The picture's own questions report errors. Here, only a point of the curve is missing.
    }
    if (question === this.#question) this.counts.set(exponent, count);
  }
}
