import type { PreparedCloud } from "../cloud/cloud.ts";
import { LoadProblem, type LoadReply, type LoadRequest, missingPart, type WorkerRequest } from "./protocol.ts";
import { loadSample } from "./download.ts";
import script from "./worker.ts?worker&url";

export { LoadProblem } from "./protocol.ts";
export type { LoadRequest, ReadOptions } from "./protocol.ts";

/** A loading that has begun before anybody waits for it. */
let ahead: { request: LoadRequest; loading: Loading | Promise<PreparedCloud> } | null = null;

/** Begins to load a cloud, before the page's other parts are there. `loadCloud` goes on with the same request. */
export function loadAhead(request: LoadRequest): void {
  const loading = begin(request);
  // If it fails, the error is reported to whoever waits for it.
  if (loading instanceof Promise) loading.catch(() => undefined);
  ahead = { request, loading };
}

function begin(request: LoadRequest): Loading | Promise<PreparedCloud> {
  return request.kind === "sample" ? loadSample(request) : new Loading(request);
}

/** Ends the loading that has begun, if nobody will wait for it. */
export function forgetAhead(): void {
  if (ahead?.loading instanceof Loading) ahead.loading.end();
  ahead = null;
}

/**
 * Loads a cloud. Files are read in a worker of their own. So a large file does not block the page, and its
 * memory is freed when the worker ends.
 */
export async function loadCloud(
  request: LoadRequest,
  signal: AbortSignal,
  onProgress: (step: string, fraction: number | null) => void,
): Promise<PreparedCloud> {
  if (ahead?.request !== request) forgetAhead();
  const begun = ahead?.loading;
  ahead = null;
  const loading = begun ?? begin(request);
  return new Promise<PreparedCloud>((resolve, reject) => {
    signal.addEventListener("abort", () => reject(new DOMException("Another cloud was opened.", "AbortError")));
    if (loading instanceof Promise) {
      loading.then(resolve, reject);
      return;
    }
    loading.listen((reply) => {
      if (reply.kind === "progress") onProgress(reply.step, reply.fraction);
      else if (reply.kind === "cloud") resolve(reply.prepared);
      else reject(new LoadProblem(reply.sentence, reply.rest));
    }, reject);
  }).finally(() => {
    if (loading instanceof Loading) loading.end();
  });
}

/** A worker that loads one cloud. It keeps its replies until somebody listens. */
class Loading {
  readonly end: () => void;
  readonly #early: (() => void)[] = [];
  #onReply: ((reply: LoadReply) => void) | null = null;
  #onProblem: (problem: LoadProblem) => void = () => undefined;

  constructor(request: WorkerRequest) {
    const { worker, end } = startWorker();
    this.end = end;
    worker.onmessage = ({ data: reply }: MessageEvent<LoadReply>) => {
      this.#tell(() => this.#onReply!(reply));
    };
    worker.onerror = (event) => {
      event.preventDefault();
      // Only an error inside a running worker is an ErrorEvent. Otherwise the worker's script is missing.
      const running = event instanceof ErrorEvent;
      const problem = running
        ? new LoadProblem(`${request.name} could not be read: the browser ran out of memory or stopped the loader.`)
        : missingPart(request.name);
      this.#tell(() => this.#onProblem(problem));
    };
    worker.postMessage(request);
  }

  listen(onReply: (reply: LoadReply) => void, onProblem: (problem: LoadProblem) => void): void {
    this.#onReply = onReply;
    this.#onProblem = onProblem;
    for (const tell of this.#early.splice(0)) tell();
  }

  #tell(tell: () => void): void {
    if (this.#onReply) tell();
    else this.#early.push(tell);
  }
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
