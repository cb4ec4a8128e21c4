import { type Settings, USUAL_SETTINGS } from "../settings/settings.ts";
import { byId } from "../controls/dom.ts";

/** The settings in each folded section. */
const SECTIONS: Record<string, (keyof Settings)[]> = {
  "flip-section": ["inversion", "viewpoints"],
  "noise-section": ["denoise", "vote"],
  "surface-section": ["show", "edge"],
  "shadow-section": ["lights", "soft", "ambient", "smoothing"],
};

/** Unfolds the sections with a setting that is not usual: the user must find what changes the picture. */
export function bindSections(settings: Settings): void {
  for (const [id, names] of Object.entries(SECTIONS)) {
    if (names.some((name) => settings[name] !== USUAL_SETTINGS[name])) byId(id, HTMLDetailsElement).open = true;
  }
}
