import type { Page } from "playwright-core";

interface Gate {
  /** Holds back the questions to the package's workers from now on. */
  hold: () => void;
  release: () => void;
}

/** Lets a test hold back the questions to the package's workers. Pass it to `openPage`. */
export async function holdable(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const waiting: (() => void)[] = [];
    let isHeld = false;
    Object.assign(globalThis, {
      hold: () => {
        isHeld = true;
      },
      release: () => {
        isHeld = false;
        for (const send of waiting.splice(0)) send();
      },
    } satisfies Gate);
    globalThis.Worker = class extends Worker {
      readonly #isAsked: boolean;

      constructor(script: string | URL, options?: WorkerOptions) {
        super(script, options);
        this.#isAsked = String(script).includes("worker-thread");
      }

      override postMessage(message: unknown, options?: Transferable[] | StructuredSerializeOptions): void {
        const send = () => {
          super.postMessage(message, options as StructuredSerializeOptions);
        };
        if (isHeld && this.#isAsked) waiting.push(send);
        else send();
      }
    };
  });
}

/** Holds back what the page asks from now on. */
export async function hold(page: Page): Promise<void> {
  await page.evaluate(() => {
    (globalThis as unknown as Gate).hold();
  });
}

export async function release(page: Page): Promise<void> {
  await page.evaluate(() => {
    (globalThis as unknown as Gate).release();
  });
}
