import { byId } from "../controls/dom.ts";
import type { Viewpoints } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";

const NOTES: Record<Viewpoints, string> = {
  one: "Points that can be seen from the camera.",
  any: "Points that can be seen from the camera or from one of four places around it, at 5 % of the distance.",
  two: "Points that can be seen from at least two places: the camera and four around it, at 5 % of the distance.",
};

/** Explains the choice of viewpoints. Hides this choice while the surface is shown. */
export function explainViewpoints(store: Store): void {
  const group = byId("viewpoints", HTMLFieldSetElement);
  const note = byId("viewpoints-note");
  store.follow(({ viewpoints, show }) => {
    group.disabled = show === "surface";
    note.textContent = show === "surface" ? "A surface has one viewpoint." : NOTES[viewpoints];
  });
}
