// Node's workers, wrapped so that a test can watch and replace them.
import { syncBuiltinESMExports } from "node:module";
import threads from "node:worker_threads";
import { afterEach, beforeEach } from "vitest";

export const OriginalWorker = threads.Worker;

export function replaceWorker(replacement: typeof threads.Worker) {
  threads.Worker = replacement;
  syncBuiltinESMExports();
}

/** Every `CountedWorker` that has not ended. */
export const running = new Set<threads.Worker>();

export class CountedWorker extends OriginalWorker {
  constructor(...args: ConstructorParameters<typeof OriginalWorker>) {
    super(...args);
    running.add(this);
    this.on("exit", () => running.delete(this));
  }
}

/** Workers that run this script before their own. */
export const workersAfter = (script: string, workerData?: unknown): typeof threads.Worker =>
  class extends CountedWorker {
    constructor(address: string | URL, options?: threads.WorkerOptions) {
      super(`${script}; import(${JSON.stringify(String(address))});`, { ...options, eval: true, workerData });
    }
  };

/** The workers that each test has started so far. They end after it. `onStart` also gets their number, from 1. */
export function watchedWorkers(onStart?: (worker: threads.Worker, number: number) => void): threads.Worker[] {
  const started: threads.Worker[] = [];
  beforeEach(() => {
    started.length = 0;
    replaceWorker(
      class extends CountedWorker {
        constructor(...args: ConstructorParameters<typeof OriginalWorker>) {
          super(...args);
          const number = started.push(this);
          onStart?.(this, number);
        }
      },
    );
  });
  afterEach(async () => {
    replaceWorker(OriginalWorker);
    await Promise.all([...running].map((worker) => worker.terminate()));
  });
  return started;
}
