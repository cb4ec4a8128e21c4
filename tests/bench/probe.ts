// Counts the bytes in array buffers of this thread. A worker that imports this file before its
// own script counts the bytes of its own thread.
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { BroadcastChannel, isMainThread } from "node:worker_threads";

export const PROBE = new URL(import.meta.url);

/** The messages on the channel that has this file's name. */
export interface Probed {
  question: { collect: boolean };
  answer: number;
}

setFlagsFromString("--expose-gc");
const collect = runInNewContext("gc") as () => void;

/** Bytes. Memory that another thread has allocated counts as external here. */
export function buffers(): number {
  const { external, arrayBuffers } = process.memoryUsage();
  return isMainThread ? external : arrayBuffers;
}

/** The same after garbage collection. */
export function collected(): number {
  collect();
  // The memory that the first collection found may not be free yet.
  collect();
  return buffers();
}

if (!isMainThread) {
  const channel = new BroadcastChannel(PROBE.href);
  channel.unref();
  channel.onmessage = (event) => {
    const { question } = (event as { data: Partial<Probed> }).data;
    if (question !== undefined) channel.postMessage({ answer: question.collect ? collected() : buffers() });
  };
}
