import type { ViewAnswer } from "../ask/views.ts";
import type { Cloud } from "../cloud/cloud.ts";
import { byId } from "../controls/dom.ts";
import { canLook, type Settings, USUAL_SETTINGS } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";
import { Moves } from "../view/moves.ts";
import type { Turning } from "../view/turning.ts";
import type { Viewer } from "../view/viewer.ts";
import { bindColor, type ColorControl } from "./color.ts";
import { bindRadius } from "./radius.ts";
import { unfoldUnusual } from "./sections.ts";
import { bindSettings } from "./settings.ts";
import { bindTheme } from "./theme.ts";
import { bindVerbs } from "./verbs.ts";

/** All controls of the panel: they change the settings, and show them. */
export class Panel {
  /** Shows the radius that an answer was found with. */
  readonly follow: (answer: ViewAnswer) => void;
  readonly #color: ColorControl;
  /** The settings that a reset goes back to. */
  usual: Pick<Settings, "fieldOfView"> = USUAL_SETTINGS;

  /** `opened`: the settings whose sections are open from the beginning. */
  constructor(viewer: Viewer, store: Store, opened: Settings, turning: Turning) {
    this.follow = bindRadius(store);
    bindSettings(store);
    const looks = byId("looks", HTMLFieldSetElement);
    store.follow((now) => (looks.disabled = !canLook(now)));
    this.#color = bindColor(store);
    viewer.onLegend = this.#color.explain;
    const moves = new Moves(byId("view", HTMLCanvasElement), viewer, store, () => this.usual);
    bindVerbs(viewer, store, moves, turning);
    bindTheme(store, (theme) => viewer.setTheme(theme));
    unfoldUnusual(opened);

    byId("reset").addEventListener("click", () => moves.reset());
  }

  /** Prepares the panel for a cloud that is about to be shown. */
  prepare(cloud: Cloud): void {
    this.#color.offer(cloud);
  }
}
