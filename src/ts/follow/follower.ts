import { asError, HprError } from "../base/errors.js";

/** One question, and what is done with its answer. */
export interface Round<Answer = unknown> {
  /** Asks the question. It may be answered at once. */
  ask(): Answer | Promise<Answer>;
  /**
   * Takes the answer up. An error that it throws is a refusal.
   *
   * @returns the function that informs the listeners. It is called after the next round has begun,
   *   because listeners may throw.
   */
  use(answer: Answer): (() => void) | undefined;
  /** Whether an error means that the question was given up. This is no refusal. */
  isGivenUp?(error: unknown): boolean;
  /** Disposes of an answer that came after the end. */
  leave?(answer: Answer): void;
}

/** What a follower asks, and who is told. */
export interface Followed {
  /** The round that is due now: always about the newest view. Undefined if nothing is to be asked. */
  next(): Round | undefined;
  /** A question was refused. `again`: the question before was refused, too, and nothing has been answered since. */
  refused(error: Error, again: boolean): void;
  /**
   * The worker was lost: drop all that was made in it. `isComingBack`: the next round begins without
   * a wish. Without this method, a loss is a refusal like any other.
   */
  lost?(isComingBack: boolean): void;
}

/**
 * Keeps answers up with something that moves, such as a camera. One round is on its way at a time.
 * When it ends, the next one asks about the view at that time; the views in between are left out.
 *
 * It may give several rounds to one view, for instance a quick answer first and a better one
 * later: `next` decides.
 *
 *     follow ──► next ──► ask ┄┄► use ──► follow
 *                          └┄┄┄┄► refused, or lost ┄┄► follow
 */
export class Follower {
  readonly #followed: Followed;
  readonly #recovery: Recovery;
  #isBusy = false;
  /** A question was refused, and nothing has been answered since. */
  #isRefused = false;
  #isStopped = false;

  constructor(followed: Followed, times?: RecoveryTimes) {
    this.#followed = followed;
    this.#recovery = new Recovery(() => {
      this.follow();
    }, times);
  }

  /** Whether a round is on its way. */
  get isBusy(): boolean {
    return this.#isBusy;
  }

  /** Whether the worker was lost and there is no other yet. */
  get isLost(): boolean {
    return this.#recovery.isLost;
  }

  /** Whether a round or another worker is on its way. */
  get isWaiting(): boolean {
    return this.#isBusy || this.#recovery.isUnderWay;
  }

  /**
   * Begins the next round. If one is on its way, the next one begins when it ends.
   *
   * @throws the error of a question that is refused at once, if `throws` is true. Otherwise the course
   *   hears of this error.
   */
  follow(throws = false): void {
    if (this.#isBusy || this.#isStopped || this.isLost) {
      return;
    }
    const round = this.#followed.next();
    if (round === undefined) {
      return;
    }
    let asked: unknown;
    try {
      asked = round.ask();
    } catch (error) {
      if (throws) {
        throw error;
      }
      this.refuse(error);
      return;
    }
    if (!(asked instanceof Promise)) {
      this.#use(round, asked);
      return;
    }
    this.#isBusy = true;
    void asked.then(
      (answer) => {
        this.#isBusy = false;
        this.#use(round, answer);
      },
      (error: unknown) => {
        this.#isBusy = false;
        this.#fail(round, error);
      },
    );
  }

  /** As `follow`, but also brings back a lost worker. To be called in each frame in which an answer is wanted. */
  wish(isNew: boolean): void {
    this.#recovery.wish(isNew);
    this.follow();
  }

  /** To be called when an answer is taken up. The next refusal does not count as `again`. */
  answered(): void {
    this.#isRefused = false;
    this.#recovery.answered();
  }

  /** To be called when something was refused, in a round or outside. */
  refuse(thrown: unknown): void {
    if (this.#isStopped) {
      return;
    }
    const error = asError(thrown);
    if (this.#followed.lost !== undefined && this.#recovery.notices(error)) {
      const { isUnderWay } = this.#recovery;
      this.#followed.lost(isUnderWay);
      if (isUnderWay) {
        return;
      }
    }
    const again = this.#isRefused;
    this.#isRefused = true;
    this.#followed.refused(error, again);
  }

  /** Ends the following. After that, nothing is asked or reported. */
  stop(): void {
    this.#isStopped = true;
    this.#recovery.stop();
  }

  #use(round: Round, answer: unknown): void {
    if (this.#isStopped) {
      round.leave?.(answer);
      return;
    }
    let tell: (() => void) | undefined;
    try {
      tell = round.use(answer);
    } catch (error) {
      this.#fail(round, error);
      return;
    }
    this.follow();
    tell?.();
  }

  /**
   * Reports the error and begins the next round. It does not wait for the next frame: if frames are
   * drawn on demand, there may be none.
   */
  #fail(round: Round, error: unknown): void {
    try {
      if (round.isGivenUp?.(error) !== true) {
        this.refuse(error);
      }
    } finally {
      this.follow();
    }
  }
}

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
