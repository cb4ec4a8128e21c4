import { Newest } from "./newest.ts";

/** {@link Newest} for questions that take long: a question hears that it was overtaken, and may give up. */
export class Overtaken<Question> extends Newest<Question> {
  #overtaking = new AbortController();

  /** Aborts when another question overtakes the one that was taken last. */
  get signal(): AbortSignal {
    return this.#overtaking.signal;
  }

  override want(question: Question): void {
    super.want(question);
    if (this.isNew) {
      this.#overtaking.abort();
    }
  }

  override take(): Question {
    this.#overtaking = new AbortController();
    return super.take();
  }
}
