import type { Instance } from "../instance/engine.js";

/** The bindings of every wasm. */
interface Freeing {
  freeCloud(handle: number): void;
}

/** Frees the clouds that were never disposed of, after nothing refers to them any more. */
export const unreachable = new FinalizationRegistry(freeCloud);

/** Frees a cloud unless its instance is lost. The number of a lost cloud may be in use again for another cloud. */
export function freeCloud({ instance, handle }: { instance: Instance<Freeing>; handle: number }): void {
  if (instance.alive) {
    instance.call((bindings) => {
      bindings.freeCloud(handle);
    });
  }
}
