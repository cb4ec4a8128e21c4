import { HprError } from "../base/errors.js";
import { importNodeModule } from "../base/node.js";
import { startBrowserWorker } from "./browser-thread.js";
import type { Thread, ThreadEvents } from "./thread.js";

/** Starts the thread that `worker-thread.ts` runs in. */
export async function startThread(events: ThreadEvents): Promise<Thread> {
  try {
    return typeof Worker === "function" ? startBrowserWorker(events) : await startNodeWorker(events);
  } catch (cause) {
    // For instance a security policy of the page.
    throw new HprError("load", `the worker could not be started: ${String(cause)}`, { cause });
  }
}

async function startNodeWorker(events: ThreadEvents): Promise<Thread> {
  const threads = await importNodeModule<typeof import("node:worker_threads")>("node:worker_threads");
  // Not in the literal form, or bundlers would take this for a second worker.
  const here = import.meta.url;
  // Without the flags of this process, some of which (--input-type) a worker refuses.
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
  // Stays to the end: Node raises an error that nobody listens to.
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
