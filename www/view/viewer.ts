import {
  ConeGeometry,
  EdgesGeometry,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  type Object3D,
  type PerspectiveCamera,
  Quaternion,
  type Vector3,
} from "three";
import { HiddenPointFilter } from "hidden-point-removal/three";
import type { Attribute, Cloud, Up } from "../cloud/cloud.ts";
import { prepareCloud } from "../cloud/prepare.ts";
import type { KnownSurface } from "../samples/samples.ts";
import type { Settings, Store, Viewpoint } from "../settings/settings.ts";
import { colorBy, type Legend } from "./colors.ts";
import { type Home, inFile, inLocal } from "./framing.ts";
import { type Inquiry, isSamePlace, type Mapped, type TimedView } from "./inquiry.ts";
import { Navigation } from "./navigation.ts";
import { CloudPoints } from "./points.ts";
import { Stage } from "./stage.ts";
import { type Theme, THEMES } from "./theme.ts";

/** A pyramid whose top is at the origin and which opens towards −z, as a camera looks. */
const PYRAMID = new EdgesGeometry(
  new ConeGeometry(0.62, 1, 4)
    .rotateY(Math.PI / 4)
    .translate(0, -0.5, 0)
    .rotateX(Math.PI / 2)
    .scale(1.16, 0.83, 1),
);

/** Marks the frozen viewpoint: a small camera in the accent color. Its size is a fixed share of the cloud's. */
export class ViewpointMarker {
  readonly #lines = new LineSegments(PYRAMID, new LineBasicMaterial());
  readonly #parent: Object3D;

  constructor(parent: Object3D) {
    this.#parent = parent;
  }

  place(at: Vector3, direction: Quaternion, size: number): void {
    this.#lines.position.copy(at);
    this.#lines.quaternion.copy(direction);
    this.#lines.scale.setScalar(size);
    this.#lines.visible = false;
    this.#parent.add(this.#lines);
  }

  setTheme({ accent }: Theme): void {
    this.#lines.material.color.set(accent);
  }

  /** From inside the marker one would see nothing but its lines, so it is hidden there. */
  follow(camera: PerspectiveCamera): void {
    this.#lines.visible = camera.position.distanceTo(this.#lines.position) > this.#lines.scale.x;
  }

  remove(): void {
    this.#lines.removeFromParent();
    this.#lines.material.dispose();
  }
}

/** A cloud that is ready to be shown, with the last answer about it. */
export interface Opened {
  cloud: Cloud;
  points: CloudPoints;
  /** The file's own coordinates. */
  positions: Float32Array | Float64Array;
  inquiry: Inquiry;
  home: Home;
  answer: TimedView;
  /** Finds the first view if `up` points up, for the present shape of the picture. */
  findHome: (up: Up) => Home;
  /** The surface that its points were taken from, if it is known. */
  surface?: KnownSurface;
}

type Shown = Opened & {
  /** The viewpoint whose points are drawn: that of the answer, or that of a map. */
  from: Viewpoint;
  /** The viewpoint of the frame before. */
  before: Viewpoint;
  /** Whether a map is drawn. */
  byMap: boolean;
  /** The direction of the frozen viewpoint. */
  frozen: Quaternion | null;
};

/** The picture: one cloud, the camera, and the viewpoint whose visible points are shown. */
export class Viewer {
  readonly stage: Stage;
  readonly navigation: Navigation;
  onAnswer: (answer: TimedView, total: number) => void = () => undefined;
  onMap: (mapped: Mapped) => void = () => undefined;
  onError: (error: unknown) => void = () => undefined;
  /**
   * Whether an answer for the present camera and settings is still to come, and whether a map shows it meanwhile. Called
   * whenever that may have changed.
   */
  onBusy: (busy: boolean, byMap: boolean) => void = () => undefined;
  /** Called with a legend whenever the colors change. */
  onLegend: (legend: Legend | null) => void = () => undefined;
  /** Called when a cloud has got another attribute to color by. */
  onAttributes: (cloud: Cloud) => void = () => undefined;
  /** Called before each frame. */
  onFrame: () => void = () => undefined;

  readonly #store: Store;
  readonly #marker: ViewpointMarker;
  #shown: Shown | null = null;
  #theme = THEMES.dark;

  /**
   * `polite`: the wheel and one finger over the picture scroll the page around it. `covered`: how many CSS pixels at the
   * bottom of the picture are covered, read when the picture gets another size.
   */
  constructor(canvas: HTMLCanvasElement, store: Store, polite: boolean, covered?: () => number) {
    this.#store = store;
    this.stage = new Stage(canvas, covered);
    this.navigation = new Navigation(this.stage.camera, canvas, polite);
    this.#marker = new ViewpointMarker(this.stage.overlay);
    this.stage.onFrame = () => {
      this.#marker.follow(this.stage.camera);
      this.#inquire();
      this.onFrame();
    };
    // Before the first move, the whole cloud stays in the picture. After it, the camera stays in its place.
    this.stage.onResize = () => {
      if (this.isHome) this.reset();
    };
    store.follow((now, before) => this.#apply(now, before));
  }

  /** Lets the first picture not wait for the graphics card's compiler. Call it before the first cloud is shown. */
  warmUp(): void {
    const { cloud } = prepareCloud({ positions: new Float32Array(3), colors: null });
    const { solid } = new CloudPoints(cloud, this.#theme);
    // A filter changes the shader. This one never gets a cloud.
    new HiddenPointFilter(solid, { cloud: () => new Promise(() => undefined) }).update(this.stage.camera);
    this.stage.compile(solid);
  }

  /** The cloud on screen. */
  get cloud(): Cloud | null {
    return this.#shown?.cloud ?? null;
  }

  /** The cloud and its visible points, for the tools. Use it only while there is a cloud. */
  get scene(): Opened & { visible: Uint32Array } {
    return { ...this.#shown!, visible: this.#shown!.answer.visibility.indices };
  }

  /** The radius of the part of the cloud that the first view shows. */
  get radius(): number {
    return this.#shown!.home.extent.radius;
  }

  /** The direction of the viewpoint: the camera's, or the frozen one. */
  get direction(): Quaternion {
    return this.#shown!.frozen ?? this.stage.camera.quaternion;
  }

  /** Whether the camera stands at the place of the first view. */
  get isHome(): boolean {
    return this.#shown !== null && this.stage.camera.position.equals(this.#shown.home.pose.at);
  }

  /** Whether it looks at the target of the first view. Orbit controls move that by a few bits. */
  get isTargetHome(): boolean {
    return (
      this.#shown !== null &&
      this.navigation.target.distanceTo(this.#shown.home.pose.target) <= 1e-9 * this.#shown.cloud.radius
    );
  }

  /** The camera's place in the file's coordinates. At the first view these are exactly the numbers that were asked for. */
  get viewpoint(): Viewpoint {
    const { cloud, home } = this.#shown!;
    return this.isHome ? home.viewpoint : inFile(cloud, this.stage.camera.position);
  }

  /** The camera's target in the file's coordinates; `null` for the middle of the cloud. */
  get target(): Viewpoint | null {
    const { target } = this.navigation;
    return target.lengthSq() === 0 ? null : inFile(this.#shown!.cloud, target);
  }

  /** Removes the cloud, so that the settings for the next one can be made. */
  clear(): void {
    if (!this.#shown) return;
    const { points, inquiry } = this.#shown;
    // First, while the geometry has the filter's index, whose buffer it frees.
    points.dispose();
    inquiry.dispose();
    for (const drawn of [points.solid, points.all]) drawn.removeFromParent();
    this.#shown = null;
    this.stage.invalidate();
  }

  /** Ends the picture and its worker. The canvas cannot be used again. */
  dispose(): void {
    this.clear();
    this.#marker.remove();
    this.navigation.dispose();
    this.stage.dispose();
  }

  /** Shows a cloud, after `clear`. */
  show(opened: Opened): void {
    const { cloud, inquiry, home, points } = opened;
    const from = opened.answer.question.viewpoint;
    const shown: Shown = (this.#shown = { ...opened, from, before: from, byMap: false, frozen: null });
    inquiry.onView = (next) => {
      Object.assign(shown, { answer: next, from: next.question.viewpoint, byMap: false });
      this.stage.invalidate();
      this.onAnswer(next, cloud.count);
    };
    inquiry.onMap = (mapped) => {
      shown.from = mapped.viewpoint;
      shown.byMap = true;
      this.stage.invalidate();
      this.onMap(mapped);
    };
    inquiry.onError = (error) => this.onError(error);
    points.setTheme(this.#theme);
    this.stage.points.add(points.solid);
    this.stage.all.add(points.all);
    this.navigation.setHome(home.pose);
    this.#applyLook(this.#store.current);
    this.#placeMarker(this.#store.current.freeze);
    this.#setUp(this.#store.current.up);
    this.#paint(this.#store.current);
    inquiry.onView(inquiry.answer!);
    this.#inquire();
  }

  /** Sets an attribute by which the cloud can be colored. `null`: takes it away. */
  setAttribute(name: string, attribute: Attribute | null): void {
    const { cloud } = this.#shown!;
    cloud.attributes = [...cloud.attributes.filter((other) => other.name !== name), ...(attribute ? [attribute] : [])];
    this.onAttributes(cloud);
    if (this.#store.current.color === name) this.#paint(this.#store.current);
  }

  /** Tints the points that are selected. */
  setChosen(indices: Uint32Array): void {
    this.#shown?.points.setChosen(indices);
    this.stage.invalidate();
  }

  /** Makes another view the first one, and moves the camera there. */
  setHome(findHome: Opened["findHome"]): void {
    if (!this.#shown) return;
    this.#shown.findHome = findHome;
    this.reset();
  }

  setTheme(theme: Theme): void {
    this.#theme = theme;
    this.stage.setTheme(theme);
    this.#marker.setTheme(theme);
    if (!this.#shown) return;
    this.#shown.points.setTheme(theme);
    this.#paint(this.#store.current);
  }

  /** Goes back to the first view. */
  reset(): void {
    if (!this.#shown) return;
    this.#shown.home = this.#shown.findHome(this.#store.current.up);
    this.navigation.setHome(this.#shown.home.pose);
    this.#placeMarker(this.#store.current.freeze);
    this.stage.invalidate();
    this.#inquire();
  }

  #apply(now: Settings, before: Settings): void {
    if (!this.#shown) return;
    const turned = now.up !== before.up;
    if (turned) this.#setUp(now.up);
    if (now.color !== before.color || turned) this.#paint(now);
    if (now.freeze !== before.freeze) this.#placeMarker(now.freeze);
    this.#applyLook(now);
    // With another side up, the camera goes back to the first view.
    if (turned) this.reset();
    this.#inquire();
  }

  #inquire(): void {
    if (!this.#shown) return;
    const settings = this.#store.current;
    const viewpoint = this.#viewpoint;
    this.#shown.inquiry.follow(viewpoint, settings);
    const { inquiry, cloud, from, before } = this.#shown;
    this.#shown.before = viewpoint;
    // From another place, the visible points leave a gap like a shadow.
    const isHere = isSamePlace(from, viewpoint, cloud.radius) || isStandIn(cloud, from, before);
    // Without an answer, the filter draws all points itself.
    this.stage.setAll({ opacity: isHere || inquiry.filter.answer === null ? 0 : 1 });
    this.onBusy(inquiry.busy, this.#shown.byMap);
  }

  /** Whether the picture is the final answer for the present camera and settings. */
  get isFinal(): boolean {
    if (!this.#shown) return false;
    const { inquiry, cloud, before } = this.#shown;
    // The camera may have moved since the last frame.
    return !inquiry.busy && isSamePlace(before, this.#viewpoint, cloud.radius);
  }

  /** The viewpoint whose visible points are shown: the camera's, or the frozen one. */
  get #viewpoint(): Viewpoint {
    return this.#store.current.freeze ?? this.viewpoint;
  }

  #paint({ color, up }: Settings): void {
    const { cloud, points } = this.#shown!;
    const { tints, legend } = colorBy(color, cloud, up, this.#theme);
    points.setTints(tints);
    this.stage.invalidate();
    this.onLegend(legend);
  }

  #setUp(up: Up): void {
    this.#shown!.points.setUp(up);
    this.stage.invalidate();
  }

  #applyLook({ hidden: chosen, freeze, compare, size, fieldOfView, box, without }: Settings): void {
    const { points, inquiry } = this.#shown!;
    points.setPart(inquiry.maskOf({ box, without }));
    inquiry.filter.mode = chosen === "off" || compare !== null ? "hide" : "dim";
    points.setGhostly(chosen === "dimmed");
    this.stage.setAll({ alone: compare ?? 0 });
    this.stage.setPointWidth(points.setPointSize(size, chosen !== "off" && freeze === null));
    this.stage.setFieldOfView(fieldOfView);
  }

  /** Marks the frozen viewpoint. It has the camera's direction if the camera is there, else it faces the target. */
  #placeMarker(freeze: Viewpoint | null): void {
    this.#marker.remove();
    const { cloud, home } = this.#shown!;
    const { camera } = this.stage;
    if (!freeze) {
      this.#shown!.frozen = null;
      this.stage.setExtent(home.extent);
      return;
    }
    const here = isSamePlace(freeze, this.viewpoint, cloud.radius);
    const at = here ? camera.position : inLocal(cloud, freeze);
    const toTarget = new Quaternion().setFromRotationMatrix(
      new Matrix4().lookAt(at, this.navigation.target, camera.up),
    );
    this.#shown!.frozen = here ? camera.quaternion.clone() : toTarget;
    this.#marker.place(at, this.#shown!.frozen, 0.18 * home.extent.radius);
    // The marker must be in the picture, too, from every place of the camera.
    const { middle, radius } = home.extent;
    this.stage.setExtent({ middle, radius: Math.max(radius, at.distanceTo(middle) + 0.2 * radius) });
  }
}

/** The cosine of the angle, seen from the middle of the cloud, up to which one place may stand in for another. */
const STAND_IN = Math.cos((2 * Math.PI) / 180);

/** Whether what one place sees may be drawn for another for a moment. */
function isStandIn(cloud: Cloud, from: Viewpoint, here: Viewpoint): boolean {
  const [a, b] = [inLocal(cloud, from), inLocal(cloud, here)];
  return a.dot(b) >= STAND_IN * a.length() * b.length();
}

/** Finds a place in the picture, in CSS pixels from its left and top. `null`: it is behind the camera. */
export function project({ scene, stage }: Viewer, place: Viewpoint): { x: number; y: number } | null {
  const { camera, size } = stage;
  const seen = inLocal(scene.cloud, place).applyMatrix4(camera.matrixWorldInverse);
  if (seen.z >= 0) return null;
  const { x, y } = seen.applyMatrix4(camera.projectionMatrix);
  return { x: (0.5 + x / 2) * size.width, y: (0.5 - y / 2) * size.height };
}
