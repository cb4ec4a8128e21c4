import type { KnownSurface } from "../samples/samples.ts";
import type { Viewpoint } from "../settings/settings.ts";
import type { Opened } from "../view/viewer.ts";

/** The cloud and the viewpoint, in the coordinates of the surface. */
export interface TruthQuestion {
  surface: KnownSurface;
  positions: Float32Array;
  viewpoint: Viewpoint;
}

/** 1 for each point that a ray reaches, or why that could not be found. */
export type TruthReply = Uint8Array | string;

/**
 * Traces rays to the true surface in a worker of its own. Resolves with 1 for each point that a ray from the viewpoint
 * reaches, and rejects if the signal aborts.
 */
export async function traced(
  { positions, cloud }: Pick<Opened, "positions" | "cloud">,
  surface: KnownSurface,
  at: Viewpoint,
  signal: AbortSignal,
): Promise<Uint8Array> {
  // A mesh is traced in f32. Coordinates in f64, such as those of a map, are measured from the middle of the cloud. The
  // truth of a generator knows its own.
  const single = positions instanceof Float32Array || "sample" in surface;
  const question: TruthQuestion = {
    // The worker has another address than the page, so it needs an absolute address.
    surface: "faces" in surface ? { faces: new URL(surface.faces, document.baseURI).href } : surface,
    positions: positions instanceof Float32Array ? positions : cloud.local,
    viewpoint: single ? at : (at.map((value, axis) => value - cloud.center[axis]!) as Viewpoint),
  };
  const worker = new Worker(new URL("./truth-worker.ts", import.meta.url), { type: "module" });
  try {
    return await new Promise((resolve, reject) => {
      signal.addEventListener("abort", () => reject(signal.reason as DOMException));
      worker.onmessage = ({ data: reply }: MessageEvent<TruthReply>) => {
        if (typeof reply === "string") reject(new Error(reply));
        else resolve(reply);
      };
      worker.onerror = (event) => {
        event.preventDefault();
        const isLate = event instanceof ErrorEvent;
        reject(new Error(isLate ? "the browser ran out of memory" : "a part of this page could not be loaded"));
      };
      worker.postMessage(question);
    });
  } finally {
    worker.terminate();
  }
}
