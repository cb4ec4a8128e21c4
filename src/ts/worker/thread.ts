import { HprError } from "../errors.js";
import { importNodeModule } from "../node.js";

/** What a thread reports. After `died` it reports nothing more. */
export interface ThreadEvents {
  message(message: unknown): void;
  died(cause: unknown): void;
}

/** A worker of the browser or of Node, seen alike. */
export interface Thread {
  post(message: unknown, transfer: ArrayBuffer[]): void;
  /** While busy, Node's process does not end. */
  setBusy(busy: boolean): void;
  /** Ends the thread, which gives its memory back. Nothing is reported any more. */
  end(): Promise<void>;
}

/** Starts the thread that `worker-thread.ts` runs in. */
export async function startThread(events: ThreadEvents): Promise<Thread> {
  try {
    return typeof Worker === "function" ? startBrowserWorker(events) : await startNodeWorker(events);
  } catch (cause) {
    // For instance a script from another origin, which browsers refuse to run.
    throw new HprError("load", `the worker could not be started: ${String(cause)}`, { cause });
  }
}

function startBrowserWorker(events: ThreadEvents): Thread {
  // One literal expression: bundlers look for exactly this form.
  const worker = new Worker(new URL("./worker-thread.js", import.meta.url), { type: "module" });
  worker.onmessage = (event) => {
    events.message(event.data);
  };
  worker.onerror = (event) => {
    // Reported here, so that the page does not report it again.
    event.preventDefault();
    events.died(event.message || "its script could not be loaded");
  };
  worker.onmessageerror = () => {
    events.died("a message could not be read");
  };
  return {
    post: (message, transfer) => {
      worker.postMessage(message, transfer);
    },
    setBusy: () => undefined,
    end: () => {
      worker.onmessage = worker.onerror = worker.onmessageerror = null;
      worker.terminate();
      return Promise.resolve();
    },
  };
}

async function startNodeWorker(events: ThreadEvents): Promise<Thread> {
  const threads =
    await importNodeModule<typeof import("node:worker_threads")>("node:worker_threads");
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
