import { Follower, type Round } from "../follow/follower.js";
import type { RecoveryTimes } from "../follow/recovery.js";
import { type AnswerKind, Refinement } from "../follow/refinement.js";
import { type FollowSettings, stagesFor } from "../query/follow-options.js";
import { isNear, type Place } from "../query/place.js";
import type { VisibilityOptions } from "../query/view-options.js";
import type { Visibility } from "../cloud/visibility.js";
import { VisibilityMap } from "../cloud/visibility-map.js";
import { WorkerPointCloud } from "../worker/client.js";

interface Listener {
  /** After this call, the answer's memory is reused. */
  answer: (answer: Visibility, kind: AnswerKind, milliseconds: number) => void;
  map: (map: VisibilityMap, from: Place) => void;
  error: (error: Error) => void;
}

type ReadPositions = () => Float32Array | Float64Array;

/** The layer makes a lost cloud again at once. If that cloud is lost, too, the layer waits for other data. */
const ONCE: RecoveryTimes = { delays: [0], pause: Infinity, longPause: Infinity };

/** A layer's cloud, in the worker that all layers share. */
export class LayerCloud {
  readonly #tell: Listener;
  readonly #refinement = new Refinement<VisibilityOptions>(() => this.#follower?.follow());
  #place: Place | undefined;
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

  /** Answers are wanted for this view. `drawsMaps`: maps can be drawn. Returns whether the view is new. */
  want(place: Place, settings: FollowSettings, drawsMaps: boolean): boolean {
    const isSame =
      this.#place !== undefined &&
      this.#settings === settings &&
      this.#drawsMaps === drawsMaps &&
      isNear(this.#place, place, settings.moveThreshold, this.#cloud?.spacing ?? 0);
    if (!isSame) {
      this.#place = place;
      this.#settings = settings;
      this.#drawsMaps = drawsMaps;
      this.#begin();
    }
    this.#follower?.follow();
    return !isSame;
  }

  #begin(): void {
    if (this.#settings !== undefined) {
      const isMapped = this.#drawsMaps && this.#place?.isDirection !== true;
      this.#refinement.moved(stagesFor(this.#settings, this.length, isMapped));
    }
  }

  dispose(): void {
    this.#refinement.stop();
    this.#follower?.stop();
    this.#follower = undefined;
    this.#dropCloud();
  }

  #next(): Round | undefined {
    if (this.#unread !== undefined) {
      return this.#preparing(this.#unread);
    }
    const [cloud, place] = [this.#cloud, this.#place];
    const isDue = cloud !== undefined && place !== undefined && this.#refinement.due !== undefined;
    return isDue ? this.#viewing(cloud, place) : undefined;
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

  #viewing(cloud: WorkerPointCloud, place: Place): Round<Visibility | VisibilityMap> {
    const begun = performance.now();
    const { from, isDirection } = place;
    return this.#refinement.round<Visibility | VisibilityMap>(
      ({ kind, options, signal }) => {
        const asked = { ...options, signal };
        if (kind === "map") {
          return cloud.visibilityMap(from, asked);
        }
        return isDirection ? cloud.visibleFromDirection(from, asked) : cloud.visibleFrom(from, asked);
      },
      (answer, stage) => {
        this.#follower?.answered();
        if (this.#settings?.stale === "all" && !stage.isCurrent()) {
          return undefined;
        }
        if (answer instanceof VisibilityMap) {
          return () => {
            this.#tell.map(answer, place);
          };
        }
        return () => {
          this.#tell.answer(answer, stage.kind, performance.now() - begun);
          cloud.recycle(answer);
        };
      },
    );
  }

  #dropCloud(): void {
    void this.#cloud?.dispose();
    this.#cloud = undefined;
  }
}
