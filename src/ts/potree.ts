import { HprError } from "./base/errors.js";
import { GatheredFilter } from "./nodes/gathered.js";
import type { Space } from "./three/cameras.js";
import type { Without } from "./query/option-types.js";
import type { HiddenPointFilterOptions } from "./three/options.js";
import { PotreeDrawing } from "./potree/drawing.js";
import { type PotreeViewer, requireViewer, type Tile } from "./potree/viewer.js";

/** The options of a `HiddenPointFilter`. Potree has no second material for hidden points. */
export type PotreeFilterOptions = HiddenPointFilterOptions & Without<"dimMaterial" | "cloud">;

const WORLD: Space = {
  updateWorldMatrix: () => undefined,
  matrixWorld: { elements: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] },
};

/**
 * Takes all visible clouds of a Potree viewer (1.7 and 1.8) as one cloud, and draws only the points that its camera
 * sees. What Potree picks and measures are these points, too. It follows the viewer's frames by itself.
 *
 * ```js
 * const filter = new PotreeFilter(viewer);
 * ```
 *
 * Viewpoints and radii are in the world's space. Points with a coordinate that is NaN or infinite are hidden, unless
 * `nonFinite` is `"error"`. Height profiles and boxes that select read the points themselves, hidden ones included.
 */
export class PotreeFilter extends GatheredFilter<Tile> {
  /** @internal */
  protected override readonly drawing: PotreeDrawing;
  readonly #leaveViewer: () => void;

  /** @throws HprError `option`. */
  constructor(viewer: PotreeViewer, options?: PotreeFilterOptions) {
    requireViewer(viewer);
    if (options !== undefined && "dimMaterial" in options) {
      throw new HprError("option", "unknown option dimMaterial: Potree's own material is dimmed");
    }
    super(WORLD, typeof options === "object" ? { nonFinite: "skip", ...options } : options);
    this.drawing = new PotreeDrawing(viewer, this.settings.dim);
    const follow = () => this.update(viewer.scene.getActiveCamera());
    viewer.addEventListener("update", follow);
    this.#leaveViewer = () => viewer.removeEventListener("update", follow);
  }

  /** Draws everything as it was before, and frees the memory of the cloud. May be called twice. */
  override dispose(): void {
    this.#leaveViewer();
    super.dispose();
  }
}

export { HprError, type HprErrorCode } from "./base/errors.js";
export type { PotreeViewer } from "./potree/viewer.js";
export type { HiddenPointNodesFilterEvents } from "./nodes/gathered.js";
export type { AskedOptions } from "./three/options.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./query/view-options.js";
export type { AnswerKind, FollowedOptions, FollowOptions } from "./follow/options.js";
