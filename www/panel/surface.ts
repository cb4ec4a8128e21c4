import type { ViewAnswer } from "../ask/views.ts";
import type { Settings, Store } from "../settings/settings.ts";
import { byId } from "../controls/dom.ts";
import { Segmented } from "../controls/segmented.ts";
import { Slider } from "../controls/slider.ts";

const number = new Intl.NumberFormat("en-US");

/** Points or the surface between them, and how long that one's edges may be. The returned function tells how many triangles there are. */
export function bindSurface(store: Store): (answer: ViewAnswer) => void {
  const show = new Segmented<Settings["show"]>("show", (value) => {
    store.change({ show: value });
  });
  const input = byId("edge", HTMLInputElement);
  // The end of the track stands for no limit.
  const all = Number(input.max);
  const edge = new Slider(
    "edge",
    (value) => (value >= all ? "all" : `${value} spacings`),
    (value) => {
      store.change({ edge: value >= all ? Infinity : value });
    },
  );
  store.follow((now) => {
    show.value = now.show;
    edge.value = now.edge === Infinity ? all : now.edge;
    input.disabled = now.show === "points";
  });
  const note = byId("surface-note");
  return ({ triangles }) => {
    note.textContent = triangles
      ? `${number.format(triangles.length / 3)} triangles between the visible points.`
      : "Triangles between the visible points, from the same hull.";
  };
}
