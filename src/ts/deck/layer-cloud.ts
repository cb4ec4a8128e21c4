import type { Visibility } from "../cloud/visibility.js";
import { VisibilityMap } from "../cloud/visibility-map.js";
import { Follower, type RecoveryTimes, type Round } from "../follow/follower.js";
import { type AnswerKind, type FollowSettings, stagesFor } from "../follow/options.js";
import { FollowedView, type Seen } from "../follow/view.js";
import type { Place } from "../query/positions.js";
import { WorkerPointCloud } from "../worker/client.js";
import { see } from "../worker/followed-cloud.js";

interface Listener {
  answer: (answer: Visibility, kind: AnswerKind, milliseconds: number) => void;
  map: (map: VisibilityMap) => void;
  error: (error: Error) => void;
}

type ReadPositions = () => Float32Array | Float64Array;

/** The layer makes a lost cloud again at once. If that cloud is lost, too, the layer waits for other data. */
const ONCE: RecoveryTimes = { delays: [0], pause: Infinity, longPause: Infinity };

/** A layer's cloud, in the worker that all layers share. */
export class LayerCloud {
  readonly #tell: Listener;
  readonly #view = new FollowedView(() => this.#follower?.follow());
  #settings: FollowSettings | undefined;
  #drawsMaps = false;
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

  /** Whether no better answer comes until the view or the positions change. */
  get settled(): boolean {
    return this.#follower?.isWaiting !== true && this.#unread === undefined && this.#view.isSettled;
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
        refused: (error) => this.#tell.error(error),
        lost: () => {
          this.#dropCloud();
          this.#unread = read;
        },
      },
      ONCE,
    );
    this.#follower.follow();
  }

  /**
   * Answers are wanted for this view, in each frame. `drawsMaps`: maps can be drawn. Returns whether all points must be
   * drawn until the next answer.
   */
  want(place: Place, settings: FollowSettings, drawsMaps: boolean): boolean {
    const isMoved = this.#view.move(place, this.#cloud?.spacing ?? 0);
    if (isMoved || this.#settings !== settings || this.#drawsMaps !== drawsMaps) {
      [this.#settings, this.#drawsMaps] = [settings, drawsMaps];
      this.#begin();
    }
    const isOutdated = this.#view.isOutdated(settings.stale);
    if (isOutdated) this.#view.drawn = undefined;
    this.#follower?.follow();
    return isOutdated;
  }

  #begin(): void {
    if (this.#settings !== undefined) {
      const isMapped = this.#drawsMaps && this.#view.place?.isDirection !== true;
      this.#view.moved(stagesFor(this.#settings, this.length, isMapped));
    }
  }

  dispose(): void {
    this.#view.stop();
    this.#follower?.stop();
    this.#follower = undefined;
    this.#dropCloud();
  }

  #next(): Round | undefined {
    if (this.#unread !== undefined) return this.#preparing(this.#unread);
    const cloud = this.#cloud;
    const isDue = this.#view.place !== undefined && this.#view.due !== undefined;
    return cloud !== undefined && isDue ? this.#viewing(cloud) : undefined;
  }

  #preparing(read: ReadPositions): Round<WorkerPointCloud> {
    return {
      ask: () => {
        this.#unread = undefined;
        // If the worker is lost, the positions are read again.
        return WorkerPointCloud.create(read().slice(), { shared: true, transfer: true });
      },
      use: (cloud) => {
        this.#cloud = cloud;
        this.#begin();
        return undefined;
      },
      leave: (cloud) => void cloud.dispose(),
    };
  }

  #viewing(cloud: WorkerPointCloud): Round<Seen> {
    return this.#view.see(
      this.#settings!.stale,
      (place, stage) => see(cloud, place, stage),
      (answer, kind, milliseconds) => {
        this.#follower?.answered();
        return () => {
          if (answer instanceof VisibilityMap) {
            this.#tell.map(answer);
            return;
          }
          this.#tell.answer(answer, kind, milliseconds);
        };
      },
    );
  }

  #dropCloud(): void {
    this.#view.drawn = undefined;
    void this.#cloud?.dispose();
    this.#cloud = undefined;
  }
}
