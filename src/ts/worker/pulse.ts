/** How often the page looks, in milliseconds. A computing worker says more often that it is alive. */
const TICK = 1000;
/** A worker that owes a reply and is silent for so many ticks has died without a word. */
const SILENT = 20;

/**
 * Notices when a worker that owes a reply says nothing more. It counts ticks of the page's own timer, not the
 * time: while the machine sleeps or the page is throttled, the worker may not run either.
 */
export class Pulse {
  readonly #lost: () => void;
  #ticks = 0;
  #timer: ReturnType<typeof setInterval> | undefined;

  constructor(lost: () => void) {
    this.#lost = lost;
  }

  /** To be called with each message of the worker. */
  heard(): void {
    this.#ticks = 0;
  }

  /** Whether the worker owes a reply from now on. */
  expect(isOwed: boolean): void {
    if (!isOwed) {
      clearInterval(this.#timer);
      this.#timer = undefined;
    } else if (this.#timer === undefined) {
      this.#ticks = 0;
      this.#timer = setInterval(() => {
        this.#tick();
      }, TICK);
      // In Node, the timer must not keep the process alive. The busy worker does.
      (this.#timer as { unref?: () => void }).unref?.();
    }
  }

  #tick(): void {
    this.#ticks += 1;
    if (this.#ticks >= SILENT) {
      this.expect(false);
      this.#lost();
    }
  }
}
