import type { Store, Viewpoints } from "../settings/settings.ts";
import { byId } from "../controls/dom.ts";
import { Segmented } from "../controls/segmented.ts";

const NOTES: Record<Viewpoints, string> = {
  one: "What the camera’s place sees.",
  any: "And what four places around it see, at 5 % of the distance.",
  two: "What two of it and four places around it see, at 5 % of the distance.",
};

/** From how many viewpoints points are to be seen; the surface is that of one. */
export function bindViewpoints(store: Store): void {
  const choice = new Segmented<Viewpoints>("viewpoints", (viewpoints) => {
    store.change({ viewpoints });
  });
  const group = byId("viewpoints", HTMLFieldSetElement);
  const note = byId("viewpoints-note");
  store.follow(({ viewpoints, show }) => {
    choice.value = viewpoints;
    group.disabled = show === "surface";
    note.textContent = show === "surface" ? "A surface is that of one viewpoint." : NOTES[viewpoints];
  });
}
