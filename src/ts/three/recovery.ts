import { HprError } from "../errors.js";

/** Milliseconds before what was lost is made again, if nothing was answered in between. */
const DELAYS = [0, 200, 1000];
/** After those, for a view that was not asked for yet, and for the same one. */
const PAUSE = 1000;
const LONG_PAUSE = 30_000;

/**
 * When to make again what is lost with its worker. At once, as a rule. Where that is lost,
 * too, before it has answered anything, after growing delays; then only while somebody
 * still wants an answer, after pauses, and sooner if it is another one.
 */
export class Recovery {
  readonly #makeAgain: () => void;
  /** In a row, without an answer. */
  #losses = 0;
  #isLost = false;
  #lostAt = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(makeAgain: () => void) {
    this.#makeAgain = makeAgain;
  }

  /** Whether there is nothing that could be asked. */
  get isLost(): boolean {
    return this.#isLost;
  }

  /** Whether it will be made again without anybody asking for it. */
  get isUnderWay(): boolean {
    return this.#timer !== undefined;
  }

  /** Whether an error is such a loss: everything that was made is to be dropped. */
  notices(error: Error): boolean {
    if (!(error instanceof HprError) || error.code !== "internal") {
      return false;
    }
    const delay = DELAYS[this.#losses++];
    this.#isLost = true;
    this.#lostAt = performance.now();
    if (delay !== undefined) {
      this.#timer = setTimeout(() => {
        this.#begin();
      }, delay);
    }
    return true;
  }

  /** To be called each frame in which an answer would be welcome. */
  wish(isNew: boolean): void {
    const pause = isNew ? PAUSE : LONG_PAUSE;
    if (this.#isLost && !this.isUnderWay && performance.now() - this.#lostAt >= pause) {
      this.#begin();
    }
  }

  answered(): void {
    this.#losses = 0;
  }

  stop(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }

  #begin(): void {
    this.#timer = undefined;
    this.#isLost = false;
    this.#makeAgain();
  }
}
