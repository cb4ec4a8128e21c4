import type { PreparedCloud } from "../cloud/cloud.ts";
import { LoadProblem, missingPart } from "./problem.ts";
import type { LoadReply, LoadRequest } from "./protocol.ts";
import script from "./worker.ts?worker&url";

export { LoadProblem } from "./problem.ts";
export type { LoadRequest } from "./protocol.ts";

/**
 * Loads a cloud in its own worker. So a large file does not block the page, and its memory is freed when the worker
 * ends. `onPoints`: takes the points that have been read so far; see `LoadReply`.
 */
export function loadCloud(
  request: LoadRequest,
  signal: AbortSignal,
  onProgress: (step: string, fraction: number | null) => void,
  onPoints: (points: Float32Array, first: [number, number, number]) => void = () => undefined,
): Promise<PreparedCloud> {
  const { worker, end } = startWorker();
  return new Promise<PreparedCloud>((resolve, reject) => {
    signal.addEventListener("abort", () => {
      reject(new DOMException("Another cloud was opened.", "AbortError"));
    });
    worker.onmessage = ({ data: reply }: MessageEvent<LoadReply>) => {
      if (reply.kind === "progress") onProgress(reply.step, reply.fraction);
      else if (reply.kind === "points") onPoints(reply.points, reply.first);
      else if (reply.kind === "cloud") resolve(reply.prepared);
      else reject(new LoadProblem(reply.sentence, reply.nonFinite));
    };
    worker.onerror = (event) => {
      event.preventDefault();
      // Only an error inside a running worker is an ErrorEvent. Otherwise the worker's script is missing.
      const running = event instanceof ErrorEvent;
      reject(
        running
          ? new LoadProblem(`${request.name} could not be read: the browser ran out of memory or stopped the loader.`)
          : missingPart(request.name),
      );
    };
    worker.postMessage(request);
  }).finally(end);
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
