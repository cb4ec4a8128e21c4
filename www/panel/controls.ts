import type { ViewAnswer } from "../ask/views.ts";
import { type Inversion, type Settings, type Store, USUAL_SETTINGS } from "../settings.ts";
import type { Viewer } from "../viewer.ts";
import type { Cloud } from "../cloud.ts";
import { bindColor, type ColorControl } from "./color.ts";
import { byId } from "./dom.ts";
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

const FIELD_OF_VIEW = { least: 5, most: 100 };

/** All of the panel's controls and the keys that stand for them: they change the settings and show what these are. */
export class Controls {
  private readonly radius: RadiusControl;
  private readonly followInversion: (resolved: Inversion) => void;
  private readonly followSurface: (answer: ViewAnswer) => void;
  private readonly color: ColorControl;
  /** What a reset goes back to. */
  usual: Pick<Settings, "fieldOfView"> = USUAL_SETTINGS;

  /** `opened`: the settings whose sections are open from the beginning. */
  constructor(viewer: Viewer, store: Store, opened: Settings) {
    this.radius = new RadiusControl(store);
    this.followInversion = bindInversion(store);
    bindViewpoints(store);
    bindNoise(store);
    this.followSurface = bindSurface(store);
    bindShadows(store, viewer);
    const { nextHidden } = bindLook(store);
    this.color = bindColor(store);
    viewer.onLegend = this.color.explain;
    const toggleFreeze = bindFreeze(store, viewer);
    bindTheme(store, (theme) => {
      viewer.setTheme(theme);
    });
    bindSections(opened);

    const reset = () => {
      store.change({ fieldOfView: this.usual.fieldOfView });
      viewer.reset();
    };
    byId("reset").addEventListener("click", reset);
    viewer.navigation.onFieldOfView = (factor) => {
      const wanted = store.current.fieldOfView * factor;
      store.change({ fieldOfView: Math.min(FIELD_OF_VIEW.most, Math.max(FIELD_OF_VIEW.least, wanted)) });
    };
    const keys: Record<string, () => void> = { v: toggleFreeze, f: bindFullScreen(), r: reset, h: nextHidden };
    byId("view").addEventListener("keydown", (event) => {
      if (!event.ctrlKey && !event.metaKey && !event.altKey) keys[event.key.toLowerCase()]?.();
    });
  }

  /** For a cloud that is about to be shown. */
  prepare(cloud: Cloud): void {
    this.color.offer(cloud);
  }

  /** Shows what the answer was found with. */
  follow(answer: ViewAnswer): void {
    this.radius.follow(answer);
    this.followSurface(answer);
    this.followInversion(answer.visibility.inversion);
  }

  markAutomatic(exponent: number): void {
    this.radius.markAutomatic(exponent);
  }
}
