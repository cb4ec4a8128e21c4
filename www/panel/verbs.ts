import { byId, isCalm } from "../controls/controls.ts";
import type { Vector3 } from "three";
import { inLocal } from "../view/framing.ts";
import { MIDDLE } from "../settings/limits.ts";
import type { Store } from "../settings/settings.ts";
import type { Moves, Turning } from "../view/moves.ts";
import type { Viewer } from "../view/viewer.ts";

/** How many times as fast as usual the camera walks around a frozen viewpoint. */
const WALK = 5;
/** In radians. */
const ASIDE = 0.9;

/** The verbs over the picture: compare, freeze and walk around, and where the frozen eye goes next. */
export function bindVerbs(viewer: Viewer, store: Store, moves: Moves, turning: Turning): void {
  const compare = byId("compare");
  compare.addEventListener("click", () => store.change({ compare: store.current.compare === null ? MIDDLE : null }));
  byId("open-scan").addEventListener("click", () => byId("file").click());
  const freeze = byId("walk");
  const here = byId("eye-here");
  /** Where the camera looked before. */
  let before: Vector3 | null = null;
  freeze.addEventListener("click", () => {
    const { freeze: eye } = store.current;
    if (!viewer.cloud) return;
    if (eye) {
      const target = before ?? viewer.navigation.target.clone();
      store.change({ freeze: null, hidden: "off" });
      viewer.navigation.flyTo({ at: inLocal(viewer.cloud, eye), target });
      return;
    }
    before = viewer.navigation.target.clone();
    store.change({ freeze: viewer.viewpoint, hidden: "dimmed", compare: null });
    viewer.navigation.goBack(viewer.radius, viewer.stage.shape, () => {
      if (!moves.frozen) return;
      // Without motion, the camera stands at the side at once.
      if (isCalm()) viewer.navigation.turn(ASIDE);
      else turning.begin(WALK);
    });
  });
  here.addEventListener("click", () => store.change({ freeze: viewer.viewpoint }));
  store.follow(({ freeze: frozen, compare: divided }) => {
    compare.setAttribute("aria-pressed", String(divided !== null));
    freeze.setAttribute("aria-pressed", String(frozen !== null));
    freeze.textContent = frozen ? "Unfreeze" : "Freeze and walk around";
    here.hidden = frozen === null;
    // Keys may freeze another cloud later.
    if (!frozen) before = null;
  });
}
