import type { ViewAnswer } from "../ask/views.ts";
import type { Cloud } from "../cloud/cloud.ts";
import { byId } from "../controls/dom.ts";
import { type Inversion, type Settings, USUAL_SETTINGS } from "../settings/settings.ts";
import type { Store } from "../settings/store.ts";
import { Moves } from "../view/moves.ts";
import type { Turning } from "../view/turning.ts";
import type { Viewer } from "../view/viewer.ts";
import { bindColor, type ColorControl } from "./color.ts";
import { toggleFullScreen } from "./full-screen.ts";
import { bindInversion } from "./inversion.ts";
import { explainLooks } from "./looks.ts";
import { PointSize } from "./point-size.ts";
import { RadiusControl } from "./radius.ts";
import { bindSections } from "./sections.ts";
import { bindSettings } from "./settings.ts";
import { explainViewpoints } from "./several.ts";
import { bindShadows } from "./shadows.ts";
import { explainSurface } from "./surface.ts";
import { bindTheme } from "./theme.ts";
import { bindVerbs } from "./verbs.ts";
import { bindFreeze } from "./viewpoint.ts";

/** All controls of the panel: they change the settings, and show them. */
export class Panel {
  readonly #radius: RadiusControl;
  readonly #followInversion: (resolved: Inversion) => void;
  readonly #followSurface: (answer: ViewAnswer) => void;
  readonly #color: ColorControl;
  readonly #pointSize: PointSize;
  /** The settings that a reset goes back to. */
  usual: Pick<Settings, "fieldOfView"> = USUAL_SETTINGS;

  /** `opened`: the settings whose sections are open from the beginning. */
  constructor(viewer: Viewer, store: Store, opened: Settings, turning: Turning) {
    this.#radius = new RadiusControl(store);
    bindSettings(store);
    explainLooks(store);
    this.#followInversion = bindInversion(store);
    explainViewpoints(store);
    this.#followSurface = explainSurface(store);
    bindShadows(store, viewer);
    this.#color = bindColor(store);
    viewer.onLegend = this.#color.explain;
    const moves = new Moves(byId("view", HTMLCanvasElement), viewer, store, () => this.usual, {
      fullScreen: toggleFullScreen,
    });
    bindFreeze(store, moves);
    bindVerbs(viewer, store, moves, turning);
    this.#pointSize = new PointSize(store);
    bindTheme(store, (theme) => {
      viewer.setTheme(theme);
    });
    bindSections(opened);

    byId("reset").addEventListener("click", () => {
      moves.reset();
    });
  }

  /** Prepares the panel for a cloud that is about to be shown. */
  prepare(cloud: Cloud): void {
    this.#color.offer(cloud);
  }

  /** Takes the size with which the points of the cloud on screen touch. */
  set touching(size: number) {
    this.#pointSize.touching = size;
  }

  /** Shows the parameters that an answer was found with. */
  follow(answer: ViewAnswer): void {
    this.#radius.follow(answer);
    this.#followSurface(answer);
    const { inversion } = answer.visibility;
    // The page asks for one inversion. An answer from several looks has no inversion to show.
    if (inversion === "spherical" || !("looks" in inversion)) this.#followInversion(inversion);
  }

  markAutomatic(exponent: number): void {
    this.#radius.markAutomatic(exponent);
  }
}
