import type { ViewAnswer } from "../ask/views.ts";
import { byId } from "../controls/dom.ts";
import type { Store } from "../settings/store.ts";

const number = new Intl.NumberFormat("en-US");

/** Explains the surface. The returned function shows how many triangles an answer has. */
export function explainSurface(store: Store): (answer: ViewAnswer) => void {
  const edge = byId("edge", HTMLInputElement);
  store.follow(({ show }) => {
    edge.disabled = show === "points";
  });
  const note = byId("surface-note");
  return ({ triangles }) => {
    note.textContent = triangles
      ? `${number.format(triangles.length / 3)} triangles between the visible points.`
      : "Triangles between the visible points, from the same hull.";
  };
}
