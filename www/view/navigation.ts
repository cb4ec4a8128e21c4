import { type PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { eased, isCalm } from "../controls/controls.ts";
import { pressed } from "../controls/keys.ts";

/** The camera's place and its target, in the recentered coordinates. */
export interface Pose {
  at: Vector3;
  target: Vector3;
  up: Vector3;
}

/** Orbit, pan and zoom by mouse and touch (OrbitControls) and by keys while the canvas has the focus. */
export class Navigation {
  readonly #camera: PerspectiveCamera;
  readonly #canvas: HTMLCanvasElement;
  /** Whether the wheel and one finger scroll the page around, as long as the picture does not have the focus. */
  readonly #polite: boolean;
  #controls: OrbitControls;
  #flight: Flight | null = null;

  constructor(camera: PerspectiveCamera, canvas: HTMLCanvasElement, polite: boolean) {
    this.#camera = camera;
    this.#canvas = canvas;
    this.#polite = polite;
    this.#controls = this.#place({ at: new Vector3(0, 0, 3), target: new Vector3(), up: new Vector3(0, 1, 0) });
    canvas.addEventListener("keydown", (event) => this.#onKey(event));
    // In the capture phase, before the orbit controls.
    canvas.addEventListener(
      "wheel",
      (event) => {
        // With Ctrl it is a pinch on a touchpad. If it did not zoom the picture, it would zoom the whole page.
        if (!this.#attended && !event.ctrlKey) event.stopImmediatePropagation();
      },
      { capture: true },
    );
    // The user's own move ends a flight.
    for (const move of ["pointerdown", "wheel", "keydown"]) canvas.addEventListener(move, () => (this.#flight = null));
    for (const change of ["focus", "blur"]) canvas.addEventListener(change, () => this.#shareTouch());
  }

  setHome(pose: Pose): void {
    this.#controls.dispose();
    this.#controls = this.#place(pose);
  }

  dispose(): void {
    this.#flight = null;
    this.#controls.dispose();
  }

  /** Flies to a place: it gets into the middle of the picture, at half its distance. The direction stays. */
  goTo(place: Vector3): void {
    const distance = this.#camera.position.distanceTo(place) / 2;
    const back = this.#camera.position.clone().sub(this.target).setLength(distance);
    this.flyTo({ at: place.clone().add(back), target: place.clone() });
  }

  /**
   * Flies back so far that its place and a ball around the target are both in the picture, also while it turns around the
   * middle between them. In a narrow picture the ball would be small: there it turns around the ball. `shape`: of the picture.
   * `then` is called there, unless the user moves first.
   */
  goBack(extent: number, { aspect, free }: { aspect: number; free: number }, then: () => void): void {
    const back = this.#camera.position.clone().sub(this.target);
    // A place among the points is not left for the outside.
    const radius = Math.min(extent, back.length());
    const alone = (1.6 * radius) / Math.min(aspect, free);
    const both = Math.max((back.length() + radius) / 2 / aspect, radius / free);
    const half = both < alone ? (back.length() + radius) / 2 : radius;
    const middle = this.target.clone().addScaledVector(back.normalize(), half - radius);
    const tangent = Math.tan((this.#camera.fov * Math.PI) / 360);
    // What turns comes nearer, and gets larger.
    const distance = Math.min(both, alone) / tangent + half / 2;
    this.flyTo({ at: middle.clone().addScaledVector(back, distance), target: middle }, FLIGHT, then);
  }

  get isFlying(): boolean {
    return this.#flight !== null;
  }

  /** `then` is called there, unless the user moves first. */
  flyTo(to: Flight["to"], milliseconds = FLIGHT, then: () => void = () => undefined): void {
    const flight: Flight = {
      from: { at: this.#camera.position.clone(), target: this.target.clone() },
      to,
      milliseconds,
      begun: performance.now() - (isCalm() ? milliseconds : 0),
    };
    this.#flight = flight;
    const step = () => {
      if (this.#flight !== flight) return;
      if (this.#fly(flight)) {
        requestAnimationFrame(step);
      } else {
        this.#flight = null;
        then();
      }
    };
    step();
  }

  /** Turns the camera around its target, by radians to its right. */
  turn(angle: number): void {
    this.#controls.rotateLeft(-angle);
  }

  /** One step of a flight. Returns whether there is a next one. */
  #fly({ from, to, begun, milliseconds }: Flight): boolean {
    const share = Math.min(1, (performance.now() - begun) / milliseconds);
    // It begins and ends slowly.
    const done = eased(share);
    this.#camera.position.lerpVectors(from.at, to.at, done);
    this.#controls.target.lerpVectors(from.target, to.target, done);
    this.#controls.update();
    // As in the first view: the answer is for exactly the place that was asked for.
    if (share === 1) this.#camera.position.copy(to.at);
    return share < 1;
  }

  /** The place that the camera looks at. */
  get target(): Vector3 {
    return this.#controls.target;
  }

  /** OrbitControls read the camera's up only when they are made, so each first view gets new ones. */
  #place({ at, target, up }: Pose): OrbitControls {
    this.#flight = null;
    this.#camera.up.copy(up);
    this.#camera.position.copy(at);
    const controls = new OrbitControls(this.#camera, this.#canvas);
    controls.target.copy(target);
    this.#shareTouch();
    const distance = at.distanceTo(target);
    controls.minDistance = distance / 1000;
    controls.maxDistance = distance * 30;
    controls.update();
    // The controls compute with angles and are a few bits off. The answer is for exactly the place that was asked for.
    this.#camera.position.copy(at);
    return controls;
  }

  /** Whether the wheel and one finger are meant for the picture, and not for the page around it. */
  get #attended(): boolean {
    return !this.#polite || (document.hasFocus() && this.#canvas.matches(":focus"));
  }

  /** Orbit controls would take all touches. */
  #shareTouch(): void {
    this.#canvas.style.touchAction = this.#attended ? "none" : "pan-y";
  }

  #onKey(event: KeyboardEvent): void {
    const found = pressed(event, ["pan", "orbit", "zoom"]);
    if (!found) return;
    event.preventDefault();
    const { action, nth } = found;
    if (action === "zoom") {
      // "=" is "+" without Shift.
      if (nth < 2) this.#controls.dollyIn(ZOOM_STEP);
      else this.#controls.dollyOut(ZOOM_STEP);
      return;
    }
    // The order is left, right, up, down.
    const sign = nth % 2 === 0 ? 1 : -1;
    const sideways = nth < 2;
    if (action === "pan") this.#controls.pan(sideways ? sign * PAN_STEP : 0, sideways ? 0 : sign * PAN_STEP);
    else if (sideways) this.#controls.rotateLeft(sign * ORBIT_STEP);
    else this.#controls.rotateUp(sign * ORBIT_STEP);
  }
}

interface Flight {
  from: Omit<Pose, "up">;
  to: Omit<Pose, "up">;
  begun: number;
  milliseconds: number;
}

/** The usual number of milliseconds of a flight. */
const FLIGHT = 300;

/** The steps for each press of a key: radians, a share of the distance, pixels. */
const ORBIT_STEP = Math.PI / 36;
const ZOOM_STEP = 0.92;
const PAN_STEP = 24;
