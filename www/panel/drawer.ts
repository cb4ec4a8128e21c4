import { byId, remember } from "../controls/controls.ts";

/**
 * The drawer with all controls. Until it is opened, the page is the picture with a caption and three verbs. The script in
 * the head of index.html opens it where this device remembers that it was open.
 */
export function bindDrawer(): void {
  const button = byId("drawer");
  const { dataset } = document.documentElement;
  const show = () => {
    const open = dataset["tools"] === "open";
    button.setAttribute("aria-expanded", String(open));
    button.textContent = open ? "Close tools" : "Tools";
  };
  show();
  button.addEventListener("click", () => {
    dataset["tools"] = dataset["tools"] === "open" ? "closed" : "open";
    remember("tools", dataset["tools"]);
    show();
  });
}

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
