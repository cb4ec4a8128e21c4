import { HprError } from "../errors.js";
import type { VisibilityOptions } from "../view-options.js";
import type { Visibility } from "../visibility.js";
import { WorkerPointCloud } from "../worker/client.js";

/** Where a layer is seen from, or along which direction. */
export interface View {
  from: readonly number[];
  isDirection: boolean;
  options: VisibilityOptions;
}

interface Listener {
  /** The answer is recycled afterwards. */
  answer: (answer: Visibility, milliseconds: number) => void;
  error: (error: Error) => void;
}

type ReadPositions = () => Float32Array | Float64Array;

/** A layer's cloud in the worker that all layers share, asked one view at a time: the newest next. */
export class Sight {
  readonly #tell: Listener;
  #read: ReadPositions | undefined;
  #cloud: WorkerPointCloud | undefined;
  #wanted: View | undefined;
  #asked = "";
  #busy = false;
  /** The worker was lost, and the next one has not answered yet. */
  #recovering = false;
  /** Which cloud it is about: what comes of earlier ones is left alone. */
  #epoch = 0;

  constructor(tell: Listener) {
    this.#tell = tell;
  }

  /** How many points there are. */
  get length(): number {
    return this.#cloud?.length ?? 0;
  }

  /** Throws what reading the positions throws. They are read again when the worker is lost. */
  setPositions(read: ReadPositions): void {
    this.dispose();
    this.#recovering = false;
    this.#read = read;
    this.#create(read());
  }

  want(view: View): void {
    this.#wanted = view;
    this.#next();
  }

  dispose(): void {
    this.#epoch += 1;
    this.#busy = false;
    this.#asked = "";
    this.#read = undefined;
    void this.#cloud?.dispose();
    this.#cloud = undefined;
  }

  #create(positions: Float32Array | Float64Array): void {
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
          this.#busy = this.#recovering = false;
          this.#tell.answer(visibility, performance.now() - begun);
          cloud.recycle(visibility);
          this.#next();
        }
      },
      (error: unknown) => {
        this.#fail(error, epoch);
      },
    );
  }

  #fail(error: unknown, epoch: number): void {
    if (epoch !== this.#epoch) {
      return;
    }
    this.#busy = false;
    if (error instanceof HprError && error.code === "internal") {
      // With the worker, its clouds are lost.
      const [read, wasRecovering] = [this.#read, this.#recovering];
      this.dispose();
      if (!wasRecovering && this.#createAgain(read)) {
        return;
      }
    }
    this.#tell.error(error as Error);
    this.#next();
  }

  #createAgain(read: ReadPositions | undefined): boolean {
    try {
      if (read !== undefined) this.setPositions(read);
    } catch {
      // The data has become something else; the layer hears of that, too.
      return false;
    }
    this.#recovering = true;
    return read !== undefined;
  }
}
