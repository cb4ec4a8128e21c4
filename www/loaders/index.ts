import type { PreparedCloud } from "../cloud/cloud.ts";
import { LoadProblem, type LoadReply, type LoadRequest, missingPart, type WorkerRequest } from "./protocol.ts";
import { loadSample } from "./download.ts";
import script from "./worker.ts?worker&url";

export { LoadProblem } from "./protocol.ts";
export type { LoadRequest, ReadOptions } from "./protocol.ts";

/** A cloud that is being loaded. */
interface Loading {
  cloud: Promise<PreparedCloud>;
  onProgress: (step: string, fraction: number | null) => void;
  end: () => void;
}

/** A loading that has begun before anybody waits for it. */
let ahead: { request: LoadRequest; loading: Loading } | null = null;

/** Begins to load a cloud, before the page's other parts are there. `loadCloud` goes on with the same request. */
export function loadAhead(request: LoadRequest): void {
  const loading = begin(request);
  // If it fails, the error is reported to whoever waits for it.
  loading.cloud.catch(() => undefined);
  ahead = { request, loading };
}

/** Ends the loading that has begun, if nobody will wait for it. */
export function forgetAhead(): void {
  ahead?.loading.end();
  ahead = null;
}

/**
 * Loads a cloud. Files are read in a worker of their own. So a large file does not block the page, and its
 * memory is freed when the worker ends.
 */
export async function loadCloud(
  request: LoadRequest,
  signal: AbortSignal,
  onProgress: Loading["onProgress"],
): Promise<PreparedCloud> {
  if (ahead?.request !== request) forgetAhead();
  const loading = ahead?.loading ?? begin(request);
  ahead = null;
  loading.onProgress = onProgress;
  const stopped = new Promise<never>((_, reject) => {
    signal.addEventListener("abort", () => reject(new DOMException("Another cloud was opened.", "AbortError")));
  });
  return Promise.race([loading.cloud, stopped]).finally(loading.end);
}

function begin(request: LoadRequest): Loading {
  const onProgress = () => undefined;
  if (request.kind === "sample") return { cloud: loadSample(request), onProgress, end: () => undefined };
  const { worker, end } = startWorker();
  const cloud = new Promise<PreparedCloud>((resolve, reject) => {
    worker.onmessage = ({ data: reply }: MessageEvent<LoadReply>) => {
      if (reply.kind === "progress") loading.onProgress(reply.step, reply.fraction);
      else if (reply.kind === "cloud") resolve(reply.prepared);
      else reject(new LoadProblem(reply.sentence, reply.rest));
    };
    worker.onerror = (event) => {
      event.preventDefault();
      // Only an error inside a running worker is an ErrorEvent. Otherwise the worker's script is missing.
      const isRunning = event instanceof ErrorEvent;
      const why = "could not be read: the browser ran out of memory or stopped the loader.";
      reject(isRunning ? new LoadProblem(`${request.name} ${why}`) : missingPart(request.name));
    };
  });
  const loading: Loading = { cloud, onProgress, end };
  worker.postMessage(request satisfies WorkerRequest);
  return loading;
}

/**
 * Browsers do not run a worker whose script comes from another origin, for instance if a page loads the element from
 * another site. But a script of the page's own origin may import that script.
 */
function startWorker(): { worker: Worker; end: () => void } {
  const { href, origin } = new URL(script, import.meta.url);
  const foreign = origin !== location.origin;
  const address = foreign
    ? URL.createObjectURL(new Blob([`import ${JSON.stringify(href)};`], { type: "text/javascript" }))
    : href;
  const worker = new Worker(address, { type: "module" });
  const end = () => {
    worker.terminate();
    if (foreign) URL.revokeObjectURL(address);
  };
  return { worker, end };
}
