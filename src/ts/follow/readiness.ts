/** A promise that is settled from outside, once. */
export class Readiness {
  readonly promise: Promise<void>;
  #settle!: { resolve: () => void; reject: (error: Error) => void };
  #isSettled = false;

  constructor() {
    this.promise = new Promise((resolve, reject) => {
      this.#settle = { resolve, reject };
    });
  }

  resolve(): void {
    this.#isSettled = true;
    this.#settle.resolve();
  }

  /**
   * An error that nobody is told of in another way becomes an unhandled rejection, also when the
   * promise is settled already.
   */
  reject(error: Error, isTold: boolean): void {
    if (isTold) {
      this.promise.catch(() => undefined);
    } else if (this.#isSettled) {
      void Promise.reject(error);
    }
    this.#isSettled = true;
    this.#settle.reject(error);
  }
}
