import { HprError } from "../base/errors.js";
import { importNodeModule, installedFile } from "../base/node.js";
import { fileOf } from "../instance/compile.js";
import { workerSource } from "../instance/configure.js";
import { startBrowserWorker } from "./browser-thread.js";
import type { Thread, ThreadEvents } from "./protocol.js";

const WAY_OUT =
  "Serve worker-thread.js (the package exports it as hidden-point-removal/worker-thread.js) and pass its address to " +
  "configure({ worker }), or await init() of hidden-point-removal/inline first, which carries it along. A security " +
  "policy must allow it in worker-src (docs/BUNDLERS.md)";

/** The error of a worker that has not started. */
export function startError(cause: unknown): HprError {
  const reason = cause instanceof Error ? cause.message : String(cause);
  return new HprError("load", `the worker could not be started: ${reason}. ${WAY_OUT}`, { cause });
}

/** Starts the thread that runs `worker-thread.ts`. */
export async function startThread(events: ThreadEvents): Promise<Thread> {
  try {
    return typeof Worker === "function" ? startBrowserWorker(events, workerSource()) : await startNodeWorker(events);
  } catch (cause) {
    // One possible cause is a security policy of the page.
    throw startError(cause);
  }
}

async function startNodeWorker(events: ThreadEvents): Promise<Thread> {
  const threads = await importNodeModule<typeof import("node:worker_threads")>("node:worker_threads");
  const { script, isText } = await scriptInNode();
  // The flags of this process are left out: a worker refuses some of them (--input-type).
  const worker = new threads.Worker(script, { execArgv: [], eval: isText });
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

async function scriptInNode(): Promise<{ script: string | URL; isText: boolean }> {
  const { address, text } = workerSource();
  if (text !== undefined) {
    return { script: text, isText: true };
  }
  if (address !== undefined) {
    return { script: fileOf(address) ?? address, isText: false };
  }
  const { existsSync } = await importNodeModule<typeof import("node:fs")>("node:fs");
  // This is not the literal form, or bundlers would take it for a second worker.
  const here = import.meta.url;
  const own = new URL("./worker-thread.js", here);
  // A bundle for a server does not have the file beside it, or has put an address of the site in its place.
  const isHere = own.protocol === "file:" && existsSync(own);
  return { script: isHere ? own : ((await installedFile("worker-thread.js", here)) ?? own), isText: false };
}
