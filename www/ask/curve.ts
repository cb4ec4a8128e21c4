import { Rest } from "../../src/ts/follow/rest.ts";
import type { Settings, Viewpoint } from "../settings/settings.ts";
import type { Inquiry } from "./inquiry.ts";
import { isSameView, methodOf, type ViewQuestion } from "./question.ts";

/** From the least radius there is to the end of the slider; every other one first, so that the shape is soon there. */
const EXPONENTS = [0, 2, 4, 6, 1, 3, 5, 0.5, 1.5, 2.5, 3.5, 4.5, 5.5];
/** So many milliseconds the picture has to be at rest. */
const REST = 400;

/** How many points are visible with one radius after another. Each is asked by itself, and only while nothing else is. */
export class Curve {
  /** By exponent. */
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

  /** Called every frame as long as the curve is looked at; `changed` after every change of it. */
  follow(viewpoint: Viewpoint, settings: Settings, changed: () => void): void {
    const viewpoints = settings.show === "points" ? settings.viewpoints : "one";
    const question: ViewQuestion = {
      viewpoint,
      method: { ...methodOf(settings), radius: null },
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
      // The picture's own questions tell what is wrong; here a point is missing.
    }
    if (question === this.#question) this.counts.set(exponent, count);
  }
}
