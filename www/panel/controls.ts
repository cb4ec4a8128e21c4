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

/** The fewer the points, the wider they are on screen: at the size that closes a dense surface they would be scales on a sparse one. */
export function usualPointSize(sample: Sample | null, count: number): number {
  return sample?.pointSize ?? (count < 20_000 ? 1.4 : count < 200_000 ? 2 : 3);
}

/** What the controls begin with for a cloud. */
export interface Settings {
  fieldOfView: number;
  pointSize: number;
  up: Up;
}

/** The panel's controls and the keys that stand for them, bound to the viewer. */
export class Controls {
  onFreeze: (frozen: boolean) => void = () => undefined;
  private readonly viewer: Viewer;
  private readonly hidden: Segmented<HiddenMode>;
  private readonly freeze: FreezeButton;
  private readonly exponent: ExponentControl;
  private readonly fieldOfView: Slider;
  private readonly pointSize: Slider;
  private usualFieldOfView = USUAL_FIELD_OF_VIEW;
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
    this.pointSize = new Slider("point-size", (value) => `${value.toFixed(1)} ×`, (value) => {
      viewer.setPointSize(value);
    });
    viewer.setPointSize(this.pointSize.value);
    this.fieldOfView = new Slider("field-of-view", (value) => `${Math.round(value)}°`, (value) => {
      viewer.stage.setFieldOfView(value);
    });
    this.up = new Segmented("up-axis", (up) => {
      this.unfreeze();
      viewer.setUp(up);
    });
    byId("reset").addEventListener("click", () => {
      this.reset();
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
  prepare({ fieldOfView, pointSize, up }: Settings): void {
    this.unfreeze();
    this.up.value = up;
    this.pointSize.value = pointSize;
    this.viewer.setPointSize(pointSize);
    this.usualFieldOfView = fieldOfView;
    this.setFieldOfView(fieldOfView);
  }

  /** Shows what the answer was found with. */
  follow(answer: Answer): void {
    this.exponent.follow(answer.visibility.exponent);
  }

  private reset(): void {
    this.setFieldOfView(this.usualFieldOfView);
    this.viewer.reset();
  }

  private setFieldOfView(degrees: number): void {
    this.fieldOfView.value = Math.min(FIELD_OF_VIEW.most, Math.max(FIELD_OF_VIEW.least, degrees));
    this.viewer.stage.setFieldOfView(this.fieldOfView.value);
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const key = event.key.toLowerCase();
    if (key === "f") this.freeze.toggle();
    else if (key === "r") this.reset();
    else if (key === "h") {
      this.hidden.value = this.hidden.next;
      this.viewer.setHiddenMode(this.hidden.value);
    }
  }
}
