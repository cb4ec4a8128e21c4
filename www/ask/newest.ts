/** Asks one question at a time. Of those that come up meanwhile only the newest is asked, so that answers keep up with the camera. */
export class Newest<Question> {
  readonly #ask: (question: Question, overtaken: AbortSignal) => Promise<void>;
  #asked: AbortController | null = null;
  #next: { question: Question } | null = null;

  /** `ask` deals with its answer and with its errors; it may give up once its question has been overtaken. */
  constructor(ask: (question: Question, overtaken: AbortSignal) => Promise<void>) {
    this.#ask = ask;
  }

  want(question: Question): void {
    this.#next = { question };
    if (this.#asked) this.#asked.abort();
    else void this.#run();
  }

  async #run(): Promise<void> {
    while (this.#next) {
      const { question } = this.#next;
      this.#next = null;
      this.#asked = new AbortController();
      await this.#ask(question, this.#asked.signal);
    }
    this.#asked = null;
  }
}
