import { addLight, lightByKey } from "../lights/moves.ts";
import type { Store } from "../settings/settings.ts";
import type { Viewer } from "../view/viewer.ts";
import { byId } from "../controls/dom.ts";
import { Slider } from "../controls/slider.ts";

const MOST_LIGHTS = 8;

/** The list of lights, and how their light falls. Where there is a light there are shadows. */
export function bindShadows(store: Store, viewer: Viewer): void {
  const add = byId("add-light", HTMLButtonElement);
  const list = byId("lights-list");
  const note = byId("lights-note");
  add.addEventListener("click", () => {
    addLight(store, viewer);
  });
  const soft = new Slider(
    "soft",
    (value) => (value === 0 ? "point lights" : value.toFixed(2)),
    (value) => {
      store.change({ soft: value });
    },
  );
  const ambient = new Slider(
    "ambient",
    (value) => value.toFixed(2),
    (value) => {
      store.change({ ambient: value });
    },
  );
  const smoothing = new Slider(
    "smoothing",
    (value) => `${value} ${value === 1 ? "round" : "rounds"}`,
    (value) => {
      store.change({ smoothing: value });
    },
  );

  const remove = (i: number) => {
    store.change({ lights: store.current.lights.filter((_, other) => other !== i) });
    // The focus must not go with the row.
    add.focus();
  };
  const row = (i: number) => {
    const item = document.createElement("li");
    const name = document.createElement("span");
    name.textContent = `Light ${i + 1}`;
    item.append(
      name,
      button("To camera", `To camera: light ${i + 1}; arrow keys move it`, () => {
        store.change({ lights: store.current.lights.with(i, viewer.viewpoint) });
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
  store.follow((now) => {
    const { length } = now.lights;
    while (list.children.length > length) list.lastElementChild!.remove();
    for (let i = list.children.length; i < length; i++) list.append(row(i));
    list.hidden = length === 0;
    add.disabled = length >= MOST_LIGHTS;
    note.textContent =
      length === 0
        ? "With a light, what it does not reach lies in shadow."
        : "Drag a light in the picture, or press the arrow keys, + and − on it.";
    for (const id of ["soft", "ambient", "smoothing"]) byId(id, HTMLInputElement).disabled = length === 0;
    soft.value = now.soft;
    ambient.value = now.ambient;
    smoothing.value = now.smoothing;
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
