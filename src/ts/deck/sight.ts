import type { VisibilityOptions } from "../view-options.js";
import type { Visibility } from "../visibility.js";
import { WorkerPointCloud } from "../worker/client.js";

/** Where a layer is seen from, or along which direction. */
export interface View {
  from: readonly number[];
  isDirection: boolean;
  options: VisibilityOptions;
}

/** A layer's cloud in the worker that all layers share, asked one view at a time: the newest next. */
export class Sight {
  readonly #tell: { answer: (answer: Visibility, milliseconds: number) => void; error: (error: Error) => void };
  #cloud: WorkerPointCloud | undefined;
  #wanted: View | undefined;
  #asked = "";
  #busy = false;
  /** Which positions it is about: what comes of earlier ones is left alone. */
  #epoch = 0;

  constructor(tell: { answer: (answer: Visibility, milliseconds: number) => void; error: (error: Error) => void }) {
    this.#tell = tell;
  }

  setPositions(positions: Float32Array | Float64Array): void {
    this.dispose();
    const epoch = this.#epoch;
    WorkerPointCloud.create(positions, { shared: true }).then(
      (cloud) => {
        if (epoch === this.#epoch) {
          this.#cloud = cloud;
          this.#next();
        } else {
          void cloud.dispose();
        }
      },
      (error: unknown) => {
        this.#fail(error, epoch);
      },
    );
  }

  want(view: View): void {
    this.#wanted = view;
    this.#next();
  }

  dispose(): void {
    this.#epoch += 1;
    this.#busy = false;
    this.#asked = "";
    void this.#cloud?.dispose();
    this.#cloud = undefined;
  }

  #next(): void {
    const [cloud, view] = [this.#cloud, this.#wanted];
    if (cloud === undefined || view === undefined || this.#busy) {
      return;
    }
    const asked = JSON.stringify(view);
    if (asked === this.#asked) {
      return;
    }
    this.#asked = asked;
    this.#busy = true;
    const epoch = this.#epoch;
    const begun = performance.now();
    const { from, isDirection, options } = view;
    const answer = isDirection ? cloud.visibleFromDirection(from, options) : cloud.visibleFrom(from, options);
    answer.then(
      (visibility) => {
        if (epoch === this.#epoch) {
          this.#busy = false;
          this.#tell.answer(visibility, performance.now() - begun);
          this.#next();
        }
      },
      (error: unknown) => {
        this.#fail(error, epoch);
      },
    );
  }

  #fail(error: unknown, epoch: number): void {
    if (epoch === this.#epoch) {
      this.#busy = false;
      this.#tell.error(error as Error);
      this.#next();
    }
  }
}
