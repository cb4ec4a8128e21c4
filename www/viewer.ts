import type { Cloud, Up } from "./cloud.ts";
import type { Answer, Refilter, Viewpoint } from "./refilter.ts";
import { findHome, type Home, inFile } from "./view/framing.ts";
import { ViewpointMarker } from "./view/marker.ts";
import { Navigation } from "./view/navigation.ts";
import { CloudPoints, type HiddenMode } from "./view/points.ts";
import { Stage } from "./view/stage.ts";

/** A cloud that is ready to be shown, with the first answer about it. */
export interface Opened {
  cloud: Cloud;
  refilter: Refilter;
  home: Home;
  up: Up;
  answer: Answer;
}

/** What is on screen: one cloud, the camera before it, and the viewpoint its points are filtered for. */
export class Viewer {
  readonly stage: Stage;
  readonly navigation: Navigation;
  /** `null`: the automatic radius. */
  exponent: number | null = null;
  onAnswer: (answer: Answer, total: number) => void = () => undefined;
  onError: (error: unknown) => void = () => undefined;

  private readonly marker: ViewpointMarker;
  private shown: (Opened & { points: CloudPoints }) | null = null;
  private frozenAt: Viewpoint | null = null;
  private mode: HiddenMode = "off";
  private pointSize = 1;

  constructor(canvas: HTMLCanvasElement) {
    this.stage = new Stage(canvas);
    this.navigation = new Navigation(this.stage.camera, canvas);
    this.marker = new ViewpointMarker(this.stage.overlay);
    this.stage.onFrame = () => {
      this.shown?.refilter.want({ viewpoint: this.frozenAt ?? this.viewpoint(), exponent: this.exponent });
    };
  }

  /** Puts a cloud in the place of the one before. */
  show(opened: Opened): void {
    if (this.shown) {
      this.shown.refilter.dispose();
      this.shown.points.solid.removeFromParent();
      this.shown.points.ghost.removeFromParent();
      this.shown.points.dispose();
    }
    const { cloud, refilter, answer, home, up } = opened;
    const points = new CloudPoints(cloud);
    this.shown = { ...opened, points };
    refilter.onAnswer = (next) => {
      points.setVisible(next.visibility.indices);
      this.stage.invalidate();
      this.onAnswer(next, cloud.count);
    };
    refilter.onError = (error) => {
      this.onError(error);
    };
    this.stage.points.add(points.solid);
    this.stage.overlay.add(points.ghost);
    points.setUp(up);
    points.show(this.mode, false);
    this.setPointSize(this.pointSize);
    this.stage.setExtent(cloud.radius);
    this.navigation.setHome(home.pose);
    refilter.onAnswer(answer);
  }

  setHiddenMode(mode: HiddenMode): void {
    this.mode = mode;
    this.shown?.points.show(mode, this.frozenAt !== null);
    this.stage.invalidate();
  }

  /** In multiples of the points' rough distance from one another. */
  setPointSize(size: number): void {
    this.pointSize = size;
    if (this.shown) this.stage.setPointWidth(this.shown.points.setPointSize(size));
  }

  /** Turns the cloud upright another way, and looks at it as for the first time. */
  setUp(up: Up): void {
    if (!this.shown) return;
    const home = findHome(this.shown.cloud, up, null, null, this.stage.camera);
    Object.assign(this.shown, { up, home });
    this.shown.points.setUp(up);
    this.navigation.setHome(home.pose);
    this.stage.invalidate();
  }

  /** Keeps the viewpoint where the camera is now, or lets it go with the camera again. */
  setFrozen(frozen: boolean): void {
    this.marker.remove();
    this.frozenAt = null;
    if (!this.shown) return;
    const { radius } = this.shown.cloud;
    // The marker has to be in the picture too, from wherever one looks back at it.
    if (frozen) {
      this.frozenAt = this.viewpoint();
      this.marker.place(this.stage.camera, 0.18 * radius);
    }
    this.shown.points.show(this.mode, frozen);
    this.stage.setExtent(frozen ? Math.max(radius, this.stage.camera.position.length() + 0.2 * radius) : radius);
  }

  /** The camera's place in the file's coordinates: at home exactly the numbers that were asked for. */
  private viewpoint(): Viewpoint {
    const { cloud, home } = this.shown!;
    const { position } = this.stage.camera;
    return position.equals(home.pose.at) ? home.viewpoint : inFile(cloud, position);
  }
}
