import type { Moves } from "../view/moves.ts";
import type { Store } from "../settings/store.ts";
import { byId } from "../controls/dom.ts";

/** The button that keeps the viewpoint where it is while the camera moves on. */
export function bindFreeze(store: Store, moves: Moves): void {
  const button = byId("freeze", HTMLButtonElement);
  button.addEventListener("click", () => {
    moves.freeze(!moves.frozen);
  });
  store.follow(({ freeze }) => {
    button.setAttribute("aria-pressed", String(freeze !== null));
    button.textContent = freeze ? "Unfreeze viewpoint" : "Freeze viewpoint";
  });
}
