import { HprError } from "../base/errors.js";
import { importNodeModule } from "../base/node.js";
import { startBrowserWorker } from "./browser-thread.js";
import type { Thread, ThreadEvents } from "./thread.js";

/** Starts the thread that runs `worker-thread.ts`. */
export async function startThread(events: ThreadEvents): Promise<Thread> {
  try {
    return typeof Worker === "function" ? startBrowserWorker(events) : await startNodeWorker(events);
  } catch (cause) {
    // One possible cause is a security policy of the page.
    throw new HprError("load", `the worker could not be started: ${String(cause)}`, { cause });
  }
}

async function startNodeWorker(events: ThreadEvents): Promise<Thread> {
  const threads = await importNodeModule<typeof import("node:worker_threads")>("node:worker_threads");
  // This is not the literal form, or bundlers would take it for a second worker.
  const here = import.meta.url;
  // The flags of this process are left out: a worker refuses some of them (--input-type).
  const worker = new threads.Worker(new URL("./worker-thread.js", here), { execArgv: [] });
  let over = false;
  worker.on("message", (message) => {
    if (!over) {
      events.message(message);
    }
  });
  const died = (cause: unknown) => {
    if (!over) {
      events.died(cause);
    }
  };
  worker.on("messageerror", died);
  // This listener stays to the end: Node throws an error that has no listener.
  worker.on("error", died);
  worker.on("exit", (code) => {
    died(`it ended with exit code ${code}`);
  });
  return {
    post: (message, transfer) => {
      worker.postMessage(message, transfer);
    },
    setBusy: (busy) => {
      if (busy) {
        worker.ref();
      } else {
        worker.unref();
      }
    },
    end: async () => {
      over = true;
      await worker.terminate();
    },
  };
}
