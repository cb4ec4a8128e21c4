import type { Up } from "../cloud.ts";
import type { Answer } from "../refilter.ts";
import type { Sample } from "../samples.ts";
import type { HiddenMode } from "../view/points.ts";
import type { Viewer } from "../viewer.ts";
import { byId } from "./dom.ts";
import { ExponentControl } from "./exponent.ts";
import { FreezeButton } from "./freeze.ts";
import { Segmented } from "./segmented.ts";
import { Slider } from "./slider.ts";

const USUAL_FIELD_OF_VIEW = 45;
const FIELD_OF_VIEW = { least: 5, most: 100 };

export function usualFieldOfView(sample: Sample | null): number {
  return sample?.fieldOfView ?? USUAL_FIELD_OF_VIEW;
}

/** The panel's controls and the keys that stand for them, bound to the viewer. */
export class Controls {
  onFreeze: (frozen: boolean) => void = () => undefined;
  private readonly viewer: Viewer;
  private readonly hidden: Segmented<HiddenMode>;
  private readonly freeze: FreezeButton;
  private readonly exponent: ExponentControl;
  private readonly fieldOfView: Slider;
  private readonly up: Segmented<Up>;

  constructor(viewer: Viewer, exponent: number | null) {
    this.viewer = viewer;
    viewer.exponent = exponent;
    this.hidden = new Segmented("hidden-points", (mode) => {
      viewer.setHiddenMode(mode);
    });
    this.freeze = new FreezeButton((frozen) => {
      viewer.setFrozen(frozen);
      this.onFreeze(frozen);
    });
    this.exponent = new ExponentControl(exponent, (value) => {
      viewer.exponent = value;
    });
    const pointSize = new Slider("point-size", (value) => `${value.toFixed(1)} ×`, (value) => {
      viewer.setPointSize(value);
    });
    viewer.setPointSize(pointSize.value);
    this.fieldOfView = new Slider("field-of-view", (value) => `${Math.round(value)}°`, (value) => {
      viewer.stage.setFieldOfView(value);
    });
    this.up = new Segmented("up-axis", (up) => {
      this.unfreeze();
      viewer.setUp(up);
    });
    byId("reset").addEventListener("click", () => {
      viewer.navigation.reset();
    });
    viewer.navigation.onFieldOfView = (factor) => {
      this.setFieldOfView(this.fieldOfView.value * factor);
    };
    byId("view").addEventListener("keydown", (event) => {
      this.onKey(event);
    });
  }

  get frozen(): boolean {
    return this.freeze.frozen;
  }

  unfreeze(): void {
    if (this.frozen) this.freeze.toggle();
  }

  /** Sets what depends on the cloud. */
  prepare(fieldOfView: number, up: Up): void {
    this.unfreeze();
    this.up.value = up;
    this.setFieldOfView(fieldOfView);
  }

  /** Shows what the answer was found with. */
  follow(answer: Answer): void {
    this.exponent.follow(answer.visibility.exponent);
  }

  private setFieldOfView(degrees: number): void {
    this.fieldOfView.value = Math.min(FIELD_OF_VIEW.most, Math.max(FIELD_OF_VIEW.least, degrees));
    this.viewer.stage.setFieldOfView(this.fieldOfView.value);
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const key = event.key.toLowerCase();
    if (key === "f") this.freeze.toggle();
    else if (key === "r") this.viewer.navigation.reset();
    else if (key === "h") {
      this.hidden.value = this.hidden.next;
      this.viewer.setHiddenMode(this.hidden.value);
    }
  }
}
