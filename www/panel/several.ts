import { byId } from "../controls/dom.ts";
import type { Viewpoints } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";

const NOTES: Record<Viewpoints, string> = {
  one: "Points that the camera’s place sees.",
  any: "Points that it sees, or one of four places around it at 5 % of the distance.",
  two: "Points that at least two see: it and four places around it at 5 % of the distance.",
};

/** Explains the choice of viewpoints. Hides this choice while the surface is shown. */
export function explainViewpoints(store: Store): void {
  const group = byId("viewpoints", HTMLFieldSetElement);
  const note = byId("viewpoints-note");
  store.follow(({ viewpoints, show }) => {
    group.disabled = show === "surface";
    note.textContent = show === "surface" ? "A surface is that of one viewpoint." : NOTES[viewpoints];
  });
}
