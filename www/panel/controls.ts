import type { ViewAnswer } from "../ask/views.ts";
import { type Inversion, type Settings, type Store, USUAL_SETTINGS } from "../settings/settings.ts";
import { Moves } from "../view/moves.ts";
import type { Viewer } from "../view/viewer.ts";
import type { Cloud } from "../cloud/cloud.ts";
import { bindColor, type ColorControl } from "./color.ts";
import { byId } from "../controls/dom.ts";
import { bindFullScreen } from "./full-screen.ts";
import { bindInversion } from "./inversion.ts";
import { bindLook } from "./look.ts";
import { bindNoise } from "./noise.ts";
import { RadiusControl } from "./radius.ts";
import { bindSections } from "./sections.ts";
import { bindShadows } from "./shadows.ts";
import { bindSurface } from "./surface.ts";
import { bindTheme } from "./theme.ts";
import { bindViewpoints } from "./several.ts";
import { bindFreeze } from "./viewpoint.ts";

/** All of the panel's controls: they change the settings and show what these are. */
export class Controls {
  readonly #radius: RadiusControl;
  readonly #followInversion: (resolved: Inversion) => void;
  readonly #followSurface: (answer: ViewAnswer) => void;
  readonly #color: ColorControl;
  /** What a reset goes back to. */
  usual: Pick<Settings, "fieldOfView"> = USUAL_SETTINGS;

  /** `opened`: the settings whose sections are open from the beginning. */
  constructor(viewer: Viewer, store: Store, opened: Settings) {
    this.#radius = new RadiusControl(store);
    this.#followInversion = bindInversion(store);
    bindViewpoints(store);
    bindNoise(store);
    this.#followSurface = bindSurface(store);
    bindShadows(store, viewer);
    bindLook(store);
    this.#color = bindColor(store);
    viewer.onLegend = this.#color.explain;
    const moves = new Moves(byId("view", HTMLCanvasElement), viewer, store, () => this.usual, { f: bindFullScreen() });
    bindFreeze(store, moves);
    bindTheme(store, (theme) => {
      viewer.setTheme(theme);
    });
    bindSections(opened);

    byId("reset").addEventListener("click", () => {
      moves.reset();
    });
  }

  /** For a cloud that is about to be shown. */
  prepare(cloud: Cloud): void {
    this.#color.offer(cloud);
  }

  /** Shows what the answer was found with. */
  follow(answer: ViewAnswer): void {
    this.#radius.follow(answer);
    this.#followSurface(answer);
    this.#followInversion(answer.visibility.inversion);
  }

  markAutomatic(exponent: number): void {
    this.#radius.markAutomatic(exponent);
  }
}
