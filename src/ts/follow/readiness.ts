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
   * Rejects the promise. If nobody hears of the error in another way (`isTold`), it becomes an
   * unhandled rejection, even if the promise is settled already.
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
