import { byId } from "../controls/dom.ts";
import { addLight, lightByKey } from "../lights/moves.ts";
import { MOST_LIGHTS } from "../settings/limits.ts";
import type { Store } from "../settings/store.ts";
import type { Viewer } from "../view/viewer.ts";

/** The list of lights. Shadows are shown as soon as there is a light. */
export function bindShadows(store: Store, viewer: Viewer): void {
  const add = byId("add-light", HTMLButtonElement);
  const list = byId("lights-list");
  const note = byId("lights-note");
  const sliders = ["soft", "ambient", "smoothing"].map((id) => byId(id, HTMLInputElement));
  add.addEventListener("click", () => {
    addLight(store, viewer);
  });

  const remove = (i: number) => {
    store.change({ lights: store.current.lights.filter((_, other) => other !== i) });
    // The focus must not vanish with the row.
    add.focus();
  };
  const row = (i: number) => {
    const item = document.createElement("li");
    const name = document.createElement("span");
    name.textContent = `Light ${i + 1}`;
    item.append(
      name,
      button("To camera", `To camera: light ${i + 1}; arrow keys move it`, () => {
        if (viewer.cloud) store.change({ lights: store.current.lights.with(i, viewer.viewpoint) });
      }),
      button("Remove", `Remove light ${i + 1}`, () => {
        remove(i);
      }),
    );
    item.addEventListener("keydown", (event) => {
      lightByKey(event, i, store, viewer);
    });
    return item;
  };
  store.follow(({ lights: { length } }) => {
    while (list.children.length > length) list.lastElementChild!.remove();
    for (let i = list.children.length; i < length; i++) list.append(row(i));
    list.hidden = length === 0;
    add.disabled = length >= MOST_LIGHTS;
    note.textContent =
      length === 0
        ? "Points that no light reaches lie in shadow."
        : "Drag a light in the picture, or press the arrow keys, + and − on it.";
    for (const slider of sliders) slider.disabled = length === 0;
  });
}

function button(text: string, label: string, run: () => void): HTMLButtonElement {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = text;
  made.ariaLabel = label;
  made.addEventListener("click", run);
  return made;
}
