import type { Page } from "playwright-core";

/** Lets a test hold back the questions to the package's workers. Pass it to `openPage`. */
export async function holdable(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const waiting: (() => void)[] = [];
    const state = { held: false };
    Object.assign(globalThis, {
      hold: () => {
        state.held = true;
      },
      release: () => {
        state.held = false;
        for (const send of waiting.splice(0)) send();
      },
    });
    globalThis.Worker = class extends Worker {
      readonly #isPackage: boolean;

      constructor(script: string | URL, options?: WorkerOptions) {
        super(script, options);
        this.#isPackage = String(script).includes("worker-thread");
      }

      override postMessage(message: unknown, options?: Transferable[] | StructuredSerializeOptions): void {
        const send = () => {
          super.postMessage(message, options as StructuredSerializeOptions);
        };
        if (this.#isPackage && state.held) waiting.push(send);
        else send();
      }
    };
  });
}

export async function hold(page: Page): Promise<void> {
  await page.evaluate(() => {
    (globalThis as unknown as { hold: () => void }).hold();
  });
}

export async function release(page: Page): Promise<void> {
  await page.evaluate(() => {
    (globalThis as unknown as { release: () => void }).release();
  });
}
