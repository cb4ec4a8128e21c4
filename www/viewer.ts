import type { Cloud, Up } from "./cloud.ts";
import type { Answer, Refilter, Viewpoint } from "./refilter.ts";
import { type Home, inFile } from "./view/framing.ts";
import { ViewpointMarker } from "./view/marker.ts";
import { Navigation } from "./view/navigation.ts";
import { CloudPoints, type HiddenMode, THROUGH_OPACITY } from "./view/points.ts";
import { Stage } from "./view/stage.ts";

/** A cloud that is ready to be shown, with the first answer about it. */
export interface Opened {
  cloud: Cloud;
  refilter: Refilter;
  home: Home;
  up: Up;
  answer: Answer;
  /** Where to look at it from with that side up, in a picture of the shape it has now. */
  findHome: (up: Up) => Home;
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
      this.marker.follow(this.stage.camera);
      this.shown?.refilter.want({ viewpoint: this.frozenAt ?? this.viewpoint(), exponent: this.exponent });
    };
    // Who has not moved yet goes on seeing the whole cloud; who has stays there.
    this.stage.onResize = () => {
      if (this.isHome) this.reset();
    };
  }

  get isEmpty(): boolean {
    return this.shown === null;
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
    points.setUp(up);
    this.showHidden();
    this.setPointSize(this.pointSize);
    this.stage.setExtent(cloud.radius);
    this.navigation.setHome(home.pose);
    refilter.onAnswer(answer);
  }

  setHiddenMode(mode: HiddenMode): void {
    this.mode = mode;
    this.showHidden();
  }

  /** In multiples of the points' rough distance from one another. */
  setPointSize(size: number): void {
    this.pointSize = size;
    if (this.shown) this.stage.setPointWidth(this.shown.points.setPointSize(size));
  }

  /** Turns the cloud upright another way, and looks at it as for the first time. */
  setUp(up: Up): void {
    if (!this.shown) return;
    this.shown.up = up;
    this.shown.points.setUp(up);
    this.reset();
  }

  /** Looks at the cloud as for the first time. */
  reset(): void {
    if (!this.shown) return;
    this.shown.home = this.shown.findHome(this.shown.up);
    this.navigation.setHome(this.shown.home.pose);
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
    this.showHidden();
    this.stage.setExtent(frozen ? Math.max(radius, this.stage.camera.position.length() + 0.2 * radius) : radius);
  }

  /**
   * Points have no size of their own, so nothing of a cloud really covers anything: as long as the viewpoint goes with the
   * camera, hidden points are drawn through the visible ones. Seen from elsewhere, they stand where they are.
   */
  private showHidden(): void {
    if (!this.shown) return;
    const { points } = this.shown;
    const frozen = this.frozenAt !== null;
    points.show(this.mode, frozen);
    (frozen ? this.stage.points : this.stage.through).add(points.ghost);
    this.stage.setThroughOpacity(THROUGH_OPACITY[this.mode]);
  }

  private get isHome(): boolean {
    return this.shown !== null && this.stage.camera.position.equals(this.shown.home.pose.at);
  }

  /** The camera's place in the file's coordinates: at home exactly the numbers that were asked for. */
  private viewpoint(): Viewpoint {
    const { cloud, home } = this.shown!;
    return this.isHome ? home.viewpoint : inFile(cloud, this.stage.camera.position);
  }
}
