import { byId } from "../controls/dom.ts";

/** On a phone the panel is a bar; this button opens the rest of it. */
export function bindSheet(): void {
  const toggle = byId("sheet-toggle", HTMLButtonElement);
  const panel = byId("panel");
  toggle.addEventListener("click", () => {
    const open = panel.classList.toggle("open");
    toggle.setAttribute("aria-expanded", String(open));
    toggle.textContent = open ? "Fewer controls" : "More controls";
  });
}
