import type { KnownSurface } from "../samples/samples.ts";
import type { Viewpoint } from "../settings/settings.ts";
import type { Opened } from "../view/viewer.ts";
import type { TruthAnswer, TruthQuestion } from "./protocol.ts";
import { Reference } from "./reference.ts";

/** A worker that traces rays from the points of a cloud to the true surface, and the question about one viewpoint. */
export class Truth {
  readonly worker: Reference<TruthQuestion, TruthAnswer>;
  readonly #surface: KnownSurface;
  readonly #origin: Viewpoint;

  constructor({ positions, cloud }: Pick<Opened, "positions" | "cloud">, surface: KnownSurface) {
    // The worker has another address than the page, so it needs an absolute address.
    this.#surface = "faces" in surface ? { faces: new URL(surface.faces, document.baseURI).href } : surface;
    // A mesh is traced in f32. Coordinates in f64, such as those of a map, are measured from the middle of the cloud.
    const single = positions instanceof Float32Array;
    this.#origin = single ? [0, 0, 0] : cloud.center;
    this.worker = new Reference(
      new Worker(new URL("./truth-worker.ts", import.meta.url), { type: "module" }),
      single ? positions : cloud.local,
    );
  }

  /** The truth beside the visible points of an answer. `hull`: those of one hull, if the answer is another one. */
  ask(at: Viewpoint, visible: Uint32Array, hull: Uint32Array | null): Promise<TruthAnswer | null> {
    const viewpoint = at.map((value, axis) => value - this.#origin[axis]!) as Viewpoint;
    return this.worker.ask({ surface: this.#surface, viewpoint, visible, hull });
  }
}
