// Node's workers, wrapped so that a test can watch and replace them.
import { syncBuiltinESMExports } from "node:module";
import threads from "node:worker_threads";

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
