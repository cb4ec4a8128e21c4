import type { Thread, ThreadEvents } from "./thread.js";

/** A thread that is a worker of the browser. */
export function startBrowserWorker(events: ThreadEvents): Thread {
  const { worker, script, started } = newWorker();
  worker.onmessage = (event) => {
    started();
    events.message(event.data);
  };
  worker.onerror = (event) => {
    started();
    // The error is reported here, so that the page does not report it again.
    event.preventDefault();
    events.died(event.message || `its script${script === undefined ? "" : ` ${script.href}`} could not be loaded`);
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
function newWorker(): NewWorker {
  const script = scriptAddress();
  if (script === undefined || script.origin === location.origin) {
    return { worker: create(), script, started: () => undefined };
  }
  const source = `import ${JSON.stringify(script.href)};`;
  const address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  return {
    worker: new Worker(address, { type: "module" }),
    script,
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
