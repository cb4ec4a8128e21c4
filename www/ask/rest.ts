/** Tells whether something that moves has come to rest. */
export class Rest {
  readonly #milliseconds: number;
  #movedAt = -Infinity;

  /** @param milliseconds without a move after which it is at rest. */
  constructor(milliseconds: number) {
    this.#milliseconds = milliseconds;
  }

  /** To be called with each move. */
  moved(): void {
    this.#movedAt = performance.now();
  }

  get isReached(): boolean {
    return performance.now() >= this.#movedAt + this.#milliseconds;
  }
}
