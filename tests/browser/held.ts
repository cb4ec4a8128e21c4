import type { Page } from "playwright-core";

interface Gate {
  /** Holds back the questions to the package's workers from this one on. The page's first worker has the number 0. */
  hold: (from: number) => void;
  release: () => void;
}

/** Lets a test hold back the questions to the package's workers. Pass it to `openPage`. */
export async function holdable(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const waiting: (() => void)[] = [];
    let first = Infinity;
    let made = 0;
    Object.assign(globalThis, {
      hold: (from: number) => {
        first = from;
      },
      release: () => {
        first = Infinity;
        for (const send of waiting.splice(0)) send();
      },
    } satisfies Gate);
    globalThis.Worker = class extends Worker {
      readonly #number: number;

      constructor(script: string | URL, options?: WorkerOptions) {
        super(script, options);
        this.#number = String(script).includes("worker-thread") ? made++ : -1;
      }

      override postMessage(message: unknown, options?: Transferable[] | StructuredSerializeOptions): void {
        const send = () => {
          super.postMessage(message, options as StructuredSerializeOptions);
        };
        if (this.#number >= first) waiting.push(send);
        else send();
      }
    };
  });
}

/** Holds back what the page asks from now on: all of it, or only what it asks other workers than the first. */
export async function hold(page: Page, workers: "all" | "others" = "all"): Promise<void> {
  await page.evaluate(
    (from) => {
      (globalThis as unknown as Gate).hold(from);
    },
    workers === "all" ? 0 : 1,
  );
}

export async function release(page: Page): Promise<void> {
  await page.evaluate(() => {
    (globalThis as unknown as Gate).release();
  });
}
