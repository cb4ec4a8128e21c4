import { HprError } from "../base/errors.js";

/** When something that was lost is made again. All in milliseconds. */
export interface RecoveryTimes {
  /** How long to wait after the first loss, the second and so on, if nothing was answered in between. */
  readonly delays: readonly number[];
  /** How long to wait after those delays, if somebody wants another view than the one that was lost. */
  readonly pause: number;
  /** The same, if somebody wants the same view. */
  readonly longPause: number;
}

const USUAL: RecoveryTimes = { delays: [0, 200, 1000], pause: 1000, longPause: 30_000 };

/**
 * Decides when a cloud that was lost with its worker is made again. The first time this is done at
 * once. If the next worker dies before it has answered, the delays grow. After the last delay, the
 * cloud is made again only while somebody wants an answer, and with pauses. A worker that hangs counts as
 * one that dies, except that the first loss in a row alone has a delay.
 */
export class Recovery {
  readonly #makeAgain: () => void;
  readonly #times: RecoveryTimes;
  /** Losses in a row, without an answer in between. */
  #losses = 0;
  #isLost = false;
  #lostAt = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(makeAgain: () => void, times: RecoveryTimes = USUAL) {
    this.#makeAgain = makeAgain;
    this.#times = times;
  }

  /** Whether there is no cloud that could be asked. */
  get isLost(): boolean {
    return this.#isLost;
  }

  /** Whether the cloud will be made again without anybody asking for it. */
  get isUnderWay(): boolean {
    return this.#timer !== undefined;
  }

  /** Returns whether an error means that the cloud is lost. Then the caller must drop the cloud. */
  notices(error: Error): boolean {
    if (!(error instanceof HprError) || error.code !== "internal") {
      return false;
    }
    // A worker that hangs costs more time than one that dies, so it is replaced only once.
    const isSlow = error.cause instanceof DOMException && error.cause.name === "TimeoutError" && this.#losses > 0;
    const delay = isSlow ? undefined : this.#times.delays[this.#losses];
    this.#losses += 1;
    this.#isLost = true;
    this.#lostAt = performance.now();
    if (delay !== undefined) {
      this.#timer = setTimeout(() => {
        this.begin();
      }, delay);
    }
    return true;
  }

  /** To be called in each frame in which somebody wants an answer. */
  wish(isNew: boolean): void {
    const { pause, longPause } = this.#times;
    const isDue = performance.now() - this.#lostAt >= (isNew ? pause : longPause);
    if (this.#isLost && !this.isUnderWay && isDue) {
      this.begin();
    }
  }

  /** To be called with each answer. */
  answered(): void {
    this.#losses = 0;
  }

  /** Makes the cloud again now. */
  begin(): void {
    this.stop();
    this.#isLost = false;
    this.#makeAgain();
  }

  stop(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
  }
}
