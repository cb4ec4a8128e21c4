import { type Settings, USUAL_SETTINGS } from "../settings/settings.ts";
import { byId } from "../controls/dom.ts";
import { remember, remembered } from "../controls/memory.ts";

/** The settings in each folded section. */
const SECTIONS: Record<string, (keyof Settings)[]> = {
  "look-section": ["color", "size", "fieldOfView", "up"],
  "advanced-section": ["looks", "radius"],
};

/**
 * Unfolds the sections that the user has left open, and those with a setting that is not usual: the user must find what
 * changes the picture.
 */
export function bindSections(settings: Settings): void {
  for (const section of document.querySelectorAll<HTMLDetailsElement>("#sheet > details")) {
    if (remembered(section.id) === "open") section.open = true;
    // Only the user's own click is remembered, not an address that opens the section.
    section.firstElementChild!.addEventListener("click", () => {
      remember(section.id, section.open ? "folded" : "open");
    });
  }
  for (const [id, names] of Object.entries(SECTIONS)) {
    if (names.some((name) => settings[name] !== USUAL_SETTINGS[name])) byId(id, HTMLDetailsElement).open = true;
  }
}
