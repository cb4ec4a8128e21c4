import { Segmented } from "../controls/segmented.ts";
import { Slider } from "../controls/slider.ts";
import { rowOf, type Settings } from "../settings/settings.ts";
import { SLIDERS } from "../settings/sliders.ts";
import type { Store } from "../settings/store.ts";
import type { SettingName } from "../settings/table.ts";

/** Settings whose only control is one row of buttons or one slider. The other controls have files of their own. */
const CHOICES = ["hidden", "looks", "up", "theme"] as const;
const SLIDING = ["size", "fieldOfView"] as const;

/** Settings that change together with another one. With another direction up, a frozen view has no meaning. */
const TOGETHER: Partial<Record<SettingName, Partial<Settings>>> = { up: { freeze: null } };

/** Binds the controls that index.html marks with the name of their setting. */
export function bindSettings(store: Store): void {
  for (const name of CHOICES) bindChoice(store, name);
  for (const name of SLIDING) bindSlider(store, name);
}

/** A row of buttons, one for each text that the panel offers for the setting. */
function bindChoice(store: Store, name: (typeof CHOICES)[number]): void {
  const row = rowOf(name);
  const choice = new Segmented(idOf(name), (text) => store.change({ [name]: row.parse(text), ...TOGETHER[name] }));
  store.follow((now) => (choice.value = row.write(now[name])));
}

function bindSlider(store: Store, name: (typeof SLIDING)[number]): void {
  const slider = new Slider(idOf(name), SLIDERS[name].text, (value) => store.change({ [name]: value }));
  store.follow((now) => (slider.value = now[name]));
}

function idOf(name: SettingName): string {
  return document.querySelector(`[data-setting="${name}"]`)!.id;
}
