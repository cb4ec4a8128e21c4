import { byId } from "../controls/dom.ts";
import { isCalm } from "../controls/motion.ts";
import { MIDDLE } from "../settings/limits.ts";
import type { Store } from "../settings/store.ts";
import type { Moves } from "../view/moves.ts";
import type { Turning } from "../view/turning.ts";
import type { Viewer } from "../view/viewer.ts";

/** How many times as fast as usual the camera walks around a frozen viewpoint. */
const WALK = 5;
/** How far back the camera goes before it walks around, in its distances: if possible so far that the eye stays in the picture. */
const BACK = { least: 1.35, most: 2.2 };

/** In radians. */
const ASIDE = 0.9;

/** The verbs over the picture: freeze and walk around, and where the frozen eye goes next. */
export function bindVerbs(viewer: Viewer, store: Store, moves: Moves, turning: Turning): void {
  const compare = byId("compare");
  compare.addEventListener("click", () => {
    store.change({ compare: store.current.compare === null ? MIDDLE : null });
  });
  byId("open-scan").addEventListener("click", () => {
    byId("file").click();
  });
  const freeze = byId("walk");
  const here = byId("eye-here");
  freeze.addEventListener("click", () => {
    if (moves.frozen) {
      moves.freeze(false);
      store.change({ hidden: "off" });
      return;
    }
    if (!viewer.cloud) return;
    store.change({ freeze: viewer.viewpoint, hidden: "dimmed", compare: null });
    const { shape, camera } = viewer.stage;
    const wide = shape.aspect * Math.tan((camera.fov * Math.PI) / 360);
    viewer.navigation.goBack(Math.min(BACK.most, Math.max(BACK.least, Math.hypot(1, 1.1 / wide))), () => {
      if (!moves.frozen) return;
      // Without motion, the camera stands at the side at once.
      if (isCalm()) viewer.navigation.turn(ASIDE);
      else turning.begin(WALK);
    });
  });
  for (const button of [here, byId("eye-here-too")]) {
    button.addEventListener("click", () => {
      store.change({ freeze: viewer.viewpoint });
    });
  }
  store.follow(({ freeze: frozen, compare: divided }) => {
    compare.setAttribute("aria-pressed", String(divided !== null));
    freeze.setAttribute("aria-pressed", String(frozen !== null));
    freeze.textContent = frozen ? "Unfreeze" : "Freeze and walk around";
    here.hidden = frozen === null;
    byId("eye-here-too").hidden = frozen === null;
  });
}
