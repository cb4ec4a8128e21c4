/** The newest of several questions, and whether it was asked already. */
export class Newest<Question> {
  readonly #isSame: (a: Question, b: Question) => boolean;
  #wanted: Question | undefined;
  #asked: Question | undefined;

  constructor(isSame: (a: Question, b: Question) => boolean) {
    this.#isSame = isSame;
  }

  /** The question that was wanted last. */
  get wanted(): Question | undefined {
    return this.#wanted;
  }

  /** The question that was asked last. */
  get asked(): Question | undefined {
    return this.#asked;
  }

  /** Whether the question that was wanted last is not the one that was asked last. */
  get isNew(): boolean {
    return this.#wanted !== undefined && !this.#isEqual(this.#wanted, this.#asked);
  }

  /** Replaces the question that was wanted before, unless it is the same. */
  want(question: Question): void {
    if (!this.#isEqual(question, this.#wanted)) {
      this.#wanted = question;
    }
  }

  /** The question that was wanted last. It counts as asked from now on. */
  take(): Question {
    return (this.#asked = this.#wanted) as Question;
  }

  /** No question counts as asked any more. */
  forget(): void {
    this.#asked = undefined;
  }

  /** Nothing is wanted any more. */
  clear(): void {
    this.#wanted = this.#asked = undefined;
  }

  #isEqual(a: Question, b: Question | undefined): boolean {
    return a === b || (b !== undefined && this.#isSame(a, b));
  }
}
