import type { Thread, ThreadEvents } from "./protocol.js";

/** Where to take the script from; without either, from the package's own file. */
interface Source {
  address?: string | URL | undefined;
  text?: string | undefined;
}

/** A thread that is a worker of the browser. */
export function startBrowserWorker(events: ThreadEvents, { address, text }: Source): Thread {
  const ways =
    text === undefined ? [() => fromScript(address)] : [() => fromText(text, "classic"), () => fromScript(undefined)];
  let current: NewWorker | undefined;
  const start = () => {
    const way = ways.shift()!;
    try {
      current = way();
    } catch (cause) {
      if (ways.length === 0) throw cause;
      start();
      return;
    }
    listen(current);
  };
  const listen = ({ worker, script, started }: NewWorker) => {
    let isRunning = false;
    worker.onmessage = (event) => {
      isRunning = true;
      started();
      events.message(event.data);
    };
    worker.onerror = (event) => {
      started();
      // The error is reported here, so that the page does not report it again.
      event.preventDefault();
      const cause = event.message || `its script${script === undefined ? "" : ` ${script.href}`} could not be loaded`;
      if (isRunning || ways.length === 0) {
        events.died(cause);
        return;
      }
      silence(worker);
      try {
        start();
      } catch (other) {
        events.died(other);
      }
    };
    worker.onmessageerror = () => {
      events.died("a message could not be read");
    };
  };
  start();
  return {
    post: (message, transfer) => {
      current?.worker.postMessage(message, transfer);
    },
    setBusy: () => undefined,
    end: () => {
      if (current !== undefined) silence(current.worker);
      return Promise.resolve();
    },
  };
}

function silence(worker: Worker): void {
  worker.onmessage = worker.onerror = worker.onmessageerror = null;
  worker.terminate();
}

/** A worker, and the function to call after its script has been read. */
interface NewWorker {
  worker: Worker;
  script: URL | undefined;
  started: () => void;
}

/**
 * Browsers do not run a worker whose script comes from another origin, for instance from a CDN. But
 * a script of the page's own origin may import that script.
 */
function fromScript(given: string | URL | undefined): NewWorker {
  const script = given === undefined ? scriptAddress() : new URL(given, location.href);
  if (script !== undefined && script.origin !== location.origin) {
    return { ...fromText(`import ${JSON.stringify(script.href)};`, "module"), script };
  }
  const worker = given === undefined ? create() : new Worker(script!, { type: "module" });
  return { worker, script, started: () => undefined };
}

/** A page in a file may start classic scripts only. */
function fromText(text: string, type: WorkerType): NewWorker {
  const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  return {
    worker: new Worker(address, { type }),
    script: undefined,
    started: () => {
      URL.revokeObjectURL(address);
    },
  };
}

function create(): Worker {
  // This must be one literal expression: bundlers look for exactly this form.
  return new Worker(new URL("./worker-thread.js", import.meta.url), { type: "module" });
}

/**
 * The address of the worker's script, wherever a bundler has put it. Undefined where `Worker`
 * cannot be replaced.
 *
 * Bundlers rewrite the call in `create`, and nothing else gives the address. So this makes the call
 * once with a constructor that only notes the address. The global is replaced for that one
 * synchronous call and put back. There are ways without this, and each is worse:
 *
 * - The same `new URL(…)` outside of `new Worker(…)` makes bundlers copy that one file without the
 *   modules that it imports. It would have to be a second copy of all of them in one file, which
 *   the user's bundler neither shares, minifies nor maps to its sources.
 * - A local variable with the name `Worker` hides the call from webpack, which follows scopes.
 * - The error for a script of another origin comes without its address.
 */
function scriptAddress(): URL | undefined {
  const scope = globalThis as { Worker: unknown };
  const original = scope.Worker;
  let address: string | URL | undefined;
  try {
    scope.Worker = function (given: string | URL) {
      address = given;
    };
  } catch {
    return undefined;
  }
  try {
    create();
    return new URL(String(address), location.href);
  } catch {
    return undefined;
  } finally {
    scope.Worker = original;
  }
}
