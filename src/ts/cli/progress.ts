/** The place where the bar is drawn. If it is not a terminal, nothing is drawn. */
export interface Screen {
  isTTY?: boolean;
  columns?: number;
  write: (text: string) => unknown;
}

const WIDTH = 24;

/** How many lines report the progress from 0 to 100 % if there is no terminal. */
const LINES = 20;

/**
 * A progress bar on a terminal. It disappears when the work is done. Without a terminal, there is no
 * bar; lines report the progress if that is wanted.
 */
export class Progress {
  readonly #screen: Screen | undefined;
  readonly #log: Screen | undefined;
  readonly #started = Date.now();
  #share = 0;
  #doing = "";
  #timer: ReturnType<typeof setInterval> | undefined;

  /** @param always whether the progress is reported without a terminal, too */
  constructor(screen: Screen, always = false) {
    this.#screen = screen.isTTY === true ? screen : undefined;
    this.#log = always && this.#screen === undefined ? screen : undefined;
  }

  /** @param share the share of the work that is done, from 0 to 1 */
  show(share: number, doing: string): void {
    if (this.#screen === undefined) {
      this.#note(share, doing);
      return;
    }
    const percent = Math.floor(100 * share);
    if (percent === Math.floor(100 * this.#share) && doing === this.#doing) return;
    [this.#share, this.#doing] = [share, doing];
    this.#draw();
    // The timer draws the seconds, also while the share does not change.
    this.#timer ??= setInterval(() => {
      this.#draw();
    }, 500).unref();
  }

  /** Takes the bar away. The next progress draws it again. */
  done(): void {
    clearInterval(this.#timer);
    if (this.#timer !== undefined) this.#screen?.write("\r\x1b[K");
    this.#timer = undefined;
  }

  /** Writes a line for each 5 %, and for each new kind of work. */
  #note(share: number, doing: string): void {
    if (Math.floor(LINES * share) === Math.floor(LINES * this.#share) && doing === this.#doing) return;
    [this.#share, this.#doing] = [share, doing];
    this.#log?.write(`${Math.floor(100 * share)} % ${doing}\n`);
  }

  #draw(): void {
    const full = Math.round(WIDTH * this.#share);
    const bar = "█".repeat(full) + "░".repeat(WIDTH - full);
    const percent = `${Math.floor(100 * this.#share)} %`.padStart(5);
    const seconds = ((Date.now() - this.#started) / 1000).toFixed(0);
    const line = `${bar} ${percent}  ${this.#doing}, ${seconds} s`;
    // Some terminals do not know their width and report 0.
    const columns = this.#screen?.columns ?? 0;
    this.#screen?.write(`\r${line.slice(0, (columns > 0 ? columns : 80) - 1)}\x1b[K`);
  }
}
