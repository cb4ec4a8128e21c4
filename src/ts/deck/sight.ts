import { Follower, type Round } from "../follow/follower.js";
import { Newest } from "../follow/newest.js";
import type { RecoveryTimes } from "../follow/recovery.js";
import type { VisibilityOptions } from "../query/view-options.js";
import type { Visibility } from "../cloud/visibility.js";
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

/** The layer makes a lost cloud again at once. If that is lost, too, it waits for other data. */
const ONCE: RecoveryTimes = { delays: [0], pause: Infinity, longPause: Infinity };

/** A layer's cloud, in the worker that all layers share. */
export class Sight {
  readonly #tell: Listener;
  readonly #views = new Newest<View>((a, b) => JSON.stringify(a) === JSON.stringify(b));
  #follower: Follower | undefined;
  #cloud: WorkerPointCloud | undefined;
  /** What reads the positions, until it is called. */
  #unread: ReadPositions | undefined;

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
