// What is in array buffers, here or, imported by a worker before its own script, there.
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { BroadcastChannel, isMainThread } from "node:worker_threads";

export const PROBE = new URL(import.meta.url);

/** What is said on the channel named as this file. */
export interface Probed {
  question: { collect: boolean };
  answer: number;
}

setFlagsFromString("--expose-gc");
const collect = runInNewContext("gc") as () => void;

/** Bytes. Those that another thread has allocated are external here. */
export function buffers(): number {
  const { external, arrayBuffers } = process.memoryUsage();
  return isMainThread ? external : arrayBuffers;
}

/** The same when nothing is left that nobody needs. */
export function collected(): number {
  collect();
  // What the first has found may still be being given back.
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
