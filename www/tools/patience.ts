import type { Viewer } from "../view/viewer.ts";

/** Lets tools wait until the picture is final: until then it is that of another place, or that of one hull. */
export class Patience {
  readonly #viewer: Viewer;
  #waiting: { run: () => void; from: string | null } | null = null;

  constructor(viewer: Viewer) {
    this.#viewer = viewer;
  }

  /** Runs something as soon as the picture is final. `here`: gives it up if the camera moves on before. */
  whenFinal(run: () => void, here = true): void {
    // Until the next frame, orbit controls leave the matrix of a moved camera half-way: at its new place, but not turned.
    this.#viewer.stage.camera.updateMatrixWorld();
    if (this.#viewer.isFinal) run();
    else this.#waiting = { run, from: here ? this.#camera : null };
  }

  /** Called every frame. */
  follow(): void {
    const waiting = this.#waiting;
    if (!waiting) return;
    if (waiting.from !== null && waiting.from !== this.#camera) {
      this.#waiting = null;
    } else if (this.#viewer.isFinal) {
      this.#waiting = null;
      waiting.run();
    }
  }

  /** Gives everything up. */
  clear(): void {
    this.#waiting = null;
  }

  get #camera(): string {
    return this.#viewer.stage.camera.matrixWorld.elements.join();
  }
}
