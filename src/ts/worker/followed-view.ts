import type { PointCloud } from "../cloud/cloud.js";
import type { Visibility } from "../cloud/visibility.js";
import { VisibilityMap } from "../cloud/visibility-map.js";
import type { Round } from "../follow/follower.js";
import { type AnswerKind, type AskedStage, Refinement } from "../follow/refinement.js";
import type { FollowSettings } from "../query/follow-options.js";
import { isFarFrom, isNear, type Place } from "../query/place.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { WorkerPointCloud } from "./client.js";

/** Both classes give the same answers. A `WorkerPointCloud` gives them as promises. */
export type Cloud = PointCloud | WorkerPointCloud;
export type Seen = Visibility | VisibilityMap;

/** Asks either kind of cloud. The signal works only in a worker: elsewhere, the answer comes at once. */
export function see(
  cloud: Cloud,
  { from, isDirection }: Place,
  { kind, options, signal, points }: AskedStage<VisibilityOptions>,
): Seen | Promise<Seen> {
  const asked = cloud instanceof WorkerPointCloud ? { ...options, signal } : options;
  if (kind === "map") {
    return cloud.visibilityMap(from, { ...asked, points });
  }
  return isDirection ? cloud.visibleFromDirection(from, asked) : cloud.visibleFrom(from, asked);
}

/** A view of a cloud that moves, and what is drawn of it. */
export class FollowedView {
  readonly refinement: Refinement<VisibilityOptions>;
  /** The question whose answer is drawn. Undefined: all points are drawn. */
  drawn: AskedStage | undefined;
  /** The place that questions are about. Undefined before the first one. */
  place: Place | undefined;
  #before: Place | undefined;
  #drawnFrom: Place | undefined;
  #map: VisibilityMap | undefined;

  /** `wake` is called when a question becomes due. */
  constructor(wake: () => void) {
    this.refinement = new Refinement(wake);
  }

  /** What is drawn. Null: all points. */
  get answer(): AnswerKind | null {
    return this.drawn?.kind ?? null;
  }

  /** Takes up the place of a frame. Returns whether it is new. `rounding`: how far rounding alone may move it. */
  move(place: Place, spacing: number, rounding = 0): boolean {
    this.#before = this.place;
    const isNew = this.place === undefined || !isNear(this.place, place, spacing, rounding);
    if (isNew) this.place = place;
    return isNew;
  }

  /** Whether the answer that is drawn must give way to all points. */
  isOutdated(stale: FollowSettings["stale"]): boolean {
    if (this.drawn === undefined || this.drawn.isCurrent()) {
      return false;
    }
    const [map, from, before] = [this.#map, this.#drawnFrom, this.#before];
    const isFar =
      map !== undefined && from !== undefined && before !== undefined && isFarFrom(from, before, map.center);
    return isFar || stale === "all";
  }

  /**
   * The round that asks the question that is due. `draw` draws the answer, and returns the function that
   * informs the listeners, or undefined if the answer is about other points.
   */
  round(
    stale: FollowSettings["stale"],
    ask: (place: Place, stage: AskedStage<VisibilityOptions>) => Seen | Promise<Seen>,
    draw: (answer: Seen, kind: AnswerKind, milliseconds: number, place: Place) => (() => void) | undefined,
  ): Round<Seen> {
    const [begun, place] = [performance.now(), this.place!];
    return this.refinement.round(
      (stage) => ask(place, stage),
      (answer, stage) => {
        if (stale === "all" && !stage.isCurrent()) {
          return undefined;
        }
        const tell = draw(answer, stage.kind, performance.now() - begun, place);
        if (tell !== undefined) {
          this.drawn = stage;
          this.#drawnFrom = place;
          if (answer instanceof VisibilityMap) this.#map = answer;
        }
        return tell;
      },
    );
  }
}
