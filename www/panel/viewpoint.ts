import type { Store } from "../settings.ts";
import type { Viewer } from "../viewer.ts";
import { byId } from "./dom.ts";

/** The button that keeps the viewpoint where it is while the camera moves on; the returned function does the same. */
export function bindFreeze(store: Store, viewer: Viewer): () => void {
  const button = byId("freeze", HTMLButtonElement);
  const toggle = () => {
    if (viewer.cloud) store.change({ freeze: store.current.freeze ? null : viewer.viewpoint });
  };
  button.addEventListener("click", toggle);
  store.follow(({ freeze }) => {
    button.setAttribute("aria-pressed", String(freeze !== null));
    button.textContent = freeze ? "Unfreeze viewpoint" : "Freeze viewpoint";
  });
  return toggle;
}
