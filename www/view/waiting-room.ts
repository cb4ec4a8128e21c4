import { BufferAttribute } from "three";
import type { Cloud, Up } from "../cloud/cloud.ts";
import type { Settings } from "../settings/settings.ts";
import { CloudAttributes } from "./attributes.ts";
import type { Home } from "./framing.ts";
import type { Navigation, Pose } from "./navigation.ts";
import { CloudPoints } from "./points.ts";
import { Preview } from "./preview.ts";
import type { Stage } from "./stage.ts";
import type { Theme } from "./theme.ts";

/** A cloud whose first answer is still to come. */
export interface Previewed {
  cloud: Cloud;
  home: Home;
  look: Pick<Settings, "size" | "fieldOfView" | "up">;
}

/**
 * The answer to fewer points comes within a second. Until then an even share of them is shown, with fewer pixels. Where the
 * processor draws, a whole picture would delay the answer.
 */
const SOON = 600_000;
const SHARE = 40_000;

/**
 * The picture while a cloud is being read and prepared: the points so far, then the whole cloud as any viewer shows it. The
 * cloud before it (`left`) is out of the picture, and can come back.
 */
export class WaitingRoom<Left> {
  /** The cloud that was in the picture before. */
  left: Left | null = null;
  isOpen = false;
  readonly #stage: Stage;
  readonly #navigation: Navigation;
  #pose: Pose | null = null;
  #preview: Preview | null = null;
  #points: CloudPoints | null = null;
  #home: Home | null = null;

  constructor(stage: Stage, navigation: Navigation) {
    this.#stage = stage;
    this.#navigation = navigation;
  }

  /** Takes the present cloud out of the picture, if that is not done yet. */
  open(left: Left | null): void {
    if (this.isOpen) return;
    this.isOpen = true;
    this.left = left;
    const { position, up } = this.#stage.camera;
    this.#pose = { at: position.clone(), target: this.#navigation.target.clone(), up: up.clone() };
    this.#home = null;
    this.#showOthers(false);
  }

  /** Adds points that have been read, measured from the first one. */
  addPoints(points: Float32Array, theme: Theme, up: Up): void {
    this.#preview ??= new Preview(this.#stage, this.#navigation, theme, up);
    this.#preview.add(points);
  }

  showCloud({ cloud, home, look }: Previewed, theme: Theme): void {
    this.#empty();
    const attributes = new CloudAttributes(cloud, theme);
    attributes.setUp(look.up);
    this.#points = new CloudPoints(cloud, attributes, theme);
    const step = cloud.count < SOON ? Math.ceil(cloud.count / SHARE) : 1;
    this.#points.all.geometry.setIndex(new BufferAttribute(everyNth(step, cloud.count), 1));
    this.#stage.all.add(this.#points.all);
    this.#stage.setCoarse(step > 1);
    // Fewer points are wider, so that they close the surface all the same.
    this.#stage.setPointWidth(this.#points.setPointSize(look.size * Math.sqrt(step)));
    this.#stage.setFieldOfView(look.fieldOfView);
    this.#stage.setExtent(home.extent);
    this.#stage.setAll({ opacity: 1, alone: 0 });
    this.#navigation.setHome(home.pose);
    this.#home = home;
  }

  /** Whether the camera was put at this first view already. */
  hasShown(home: Home): boolean {
    return this.#home === home;
  }

  /** `comesBack`: the cloud before is shown again, from where the camera was. */
  end(comesBack: boolean): void {
    if (!this.isOpen) return;
    this.isOpen = false;
    this.#stage.setCoarse(false);
    this.#empty();
    this.#showOthers(true);
    if (comesBack) {
      this.#stage.setAll({ opacity: 0 });
      if (this.left && this.#pose) this.#navigation.setHome(this.#pose);
      this.#home = null;
    }
    this.left = null;
    this.#stage.invalidate();
  }

  #empty(): void {
    this.#preview?.dispose();
    this.#points?.all.removeFromParent();
    this.#points?.dispose();
    this.#preview = this.#points = null;
  }

  /** Everything else that the stage draws. */
  #showOthers(visible: boolean): void {
    const { points, overlay, all } = this.#stage;
    for (const drawn of [points, overlay, ...all.children]) drawn.visible = visible;
  }
}

function everyNth(step: number, count: number): Uint32Array {
  const indices = new Uint32Array(Math.floor(count / step));
  for (let i = 0; i < indices.length; i++) indices[i] = i * step;
  return indices;
}
