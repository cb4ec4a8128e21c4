import { byId } from "../controls/dom.ts";
import { canLook, type Looks } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";

const NOTES: Record<Looks, string> = {
  0: "As in the paper.",
  2: "Two hulls. Each decides where it is sure: fewer errors at silhouettes. While the camera moves, one hull answers.",
  3: "Three hulls. Each decides where it is sure: fewer errors at silhouettes. While the camera moves, one hull answers.",
};

/** Explains the choice of looks, and says when there is none. */
export function explainLooks(store: Store): void {
  const group = byId("looks", HTMLFieldSetElement);
  const note = byId("looks-note");
  store.follow((now) => {
    const possible = canLook(now);
    group.disabled = !possible;
    note.textContent = possible ? NOTES[now.looks] : "Looks need the automatic radius and the spherical inversion.";
  });
}
