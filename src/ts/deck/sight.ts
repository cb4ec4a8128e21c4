import { Follower, type Round } from "../follow/follower.js";
import { Newest } from "../follow/newest.js";
import type { RecoveryTimes } from "../follow/recovery.js";
import type { VisibilityOptions } from "../query/view-options.js";
import type { Visibility } from "../cloud/visibility.js";
import { WorkerPointCloud } from "../worker/client.js";

/** The viewpoint of a layer, or the direction that it is seen along. */
export interface View {
  from: readonly number[];
  isDirection: boolean;
  options: VisibilityOptions;
}

interface Listener {
  /** After this call, the answer's memory is reused. */
  answer: (answer: Visibility, milliseconds: number) => void;
  error: (error: Error) => void;
}

type ReadPositions = () => Float32Array | Float64Array;

/** The layer makes a lost cloud again at once. If that cloud is lost, too, the layer waits for other data. */
const ONCE: RecoveryTimes = { delays: [0], pause: Infinity, longPause: Infinity };

/** A layer's cloud, in the worker that all layers share. */
export class Sight {
  readonly #tell: Listener;
  readonly #views = new Newest<View>((a, b) => JSON.stringify(a) === JSON.stringify(b));
  #follower: Follower | undefined;
  #cloud: WorkerPointCloud | undefined;
  /** Reads the positions. Undefined after it was called. */
  #unread: ReadPositions | undefined;

  constructor(tell: Listener) {
    this.#tell = tell;
  }

  /** The number of points. */
  get length(): number {
    return this.#cloud?.length ?? 0;
  }

  /**
   * Reads the positions now, and again if the worker is lost.
   *
   * @throws the error of `read`.
   */
  setPositions(read: ReadPositions): void {
    this.dispose();
    const positions = read();
    this.#unread = () => positions;
    this.#follower = new Follower(
      {
        next: () => this.#next(),
        refused: (error) => {
          this.#tell.error(error);
        },
        lost: () => {
          this.#dropCloud();
          this.#unread = read;
        },
      },
      ONCE,
    );
    this.#follower.follow();
  }

  want(view: View): void {
    this.#views.want(view);
    this.#follower?.follow();
  }

  dispose(): void {
    this.#follower?.stop();
    this.#follower = undefined;
    this.#dropCloud();
  }

  #next(): Round | undefined {
    if (this.#unread !== undefined) {
      return this.#preparing(this.#unread);
    }
    return this.#cloud !== undefined && this.#views.isNew ? this.#viewing(this.#cloud) : undefined;
  }

  #preparing(read: ReadPositions): Round<WorkerPointCloud> {
    return {
      ask: () => {
        this.#unread = undefined;
        this.#views.forget();
        return WorkerPointCloud.create(read(), { shared: true });
      },
      use: (cloud) => {
        this.#cloud = cloud;
        return undefined;
      },
      leave: (cloud) => void cloud.dispose(),
    };
  }

  #viewing(cloud: WorkerPointCloud): Round<Visibility> {
    const begun = performance.now();
    return {
      ask: () => {
        const { from, isDirection, options } = this.#views.take();
        return isDirection ? cloud.visibleFromDirection(from, options) : cloud.visibleFrom(from, options);
      },
      use: (answer) => {
        this.#follower?.answered();
        return () => {
          this.#tell.answer(answer, performance.now() - begun);
          cloud.recycle(answer);
        };
      },
    };
  }

  #dropCloud(): void {
    void this.#cloud?.dispose();
    this.#cloud = undefined;
  }
}
