import { type Settings, USUAL_SETTINGS } from "../settings/settings.ts";
import { byId } from "../controls/dom.ts";

/** The settings in each folded section. */
const SECTIONS: Record<string, (keyof Settings)[]> = {
  "look-section": ["color", "size", "fieldOfView", "up"],
  "advanced-section": ["looks", "radius"],
};

/** Unfolds the sections with a setting that is not usual: the user must find what changes the picture. */
export function unfoldUnusual(settings: Settings): void {
  for (const [id, names] of Object.entries(SECTIONS)) {
    if (names.some((name) => settings[name] !== USUAL_SETTINGS[name])) byId(id, HTMLDetailsElement).open = true;
  }
}
