import { type PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

/** Where the camera stands and what it looks at, in the recentered coordinates. */
export interface Pose {
  at: Vector3;
  target: Vector3;
  up: Vector3;
}

/** Orbit, pan and zoom by mouse and touch (OrbitControls) and by keys while the canvas has the focus. */
export class Navigation {
  /** Asks for a field of view so many times as wide as now. */
  onFieldOfView: (factor: number) => void = () => undefined;
  /** The camera has been moved. */
  onMove: () => void = () => undefined;
  readonly #camera: PerspectiveCamera;
  readonly #canvas: HTMLCanvasElement;
  /** Whether the wheel and one finger scroll the page around the picture until that has the focus. */
  readonly #polite: boolean;
  #controls: OrbitControls;

  constructor(camera: PerspectiveCamera, canvas: HTMLCanvasElement, polite: boolean) {
    this.#camera = camera;
    this.#canvas = canvas;
    this.#polite = polite;
    this.#controls = this.#place({ at: new Vector3(0, 0, 3), target: new Vector3(), up: new Vector3(0, 1, 0) });
    canvas.addEventListener("keydown", (event) => {
      this.#onKey(event);
    });
    // In the capture phase, so that the orbit controls do not zoom as well. Some systems turn the wheel sideways with Alt.
    canvas.addEventListener(
      "wheel",
      (event) => {
        // With Ctrl it is a pinch on a touchpad, or would zoom the whole page.
        const others = !this.#attended && !event.ctrlKey;
        if (others || event.altKey) event.stopImmediatePropagation();
        if (others || !event.altKey) return;
        event.preventDefault();
        this.onFieldOfView((event.deltaY || event.deltaX) > 0 ? 1.08 : 1 / 1.08);
      },
      { capture: true, passive: false },
    );
    for (const change of ["focus", "blur"])
      canvas.addEventListener(change, () => {
        this.#shareTouch();
      });
  }

  setHome(pose: Pose): void {
    this.#controls.dispose();
    this.#controls = this.#place(pose);
  }

  dispose(): void {
    this.#controls.dispose();
  }

  /** What the camera looks at. */
  get target(): Vector3 {
    return this.#controls.target;
  }

  /** OrbitControls read the camera's up once, when they are made: a new home gets new ones. */
  #place({ at, target, up }: Pose): OrbitControls {
    this.#camera.up.copy(up);
    this.#camera.position.copy(at);
    const controls = new OrbitControls(this.#camera, this.#canvas);
    controls.target.copy(target);
    this.#shareTouch();
    const distance = at.distanceTo(target);
    controls.minDistance = distance / 1000;
    controls.maxDistance = distance * 1000;
    controls.update();
    // The controls go by angles and come back a few bits off; the viewpoint asked for is the one to answer.
    this.#camera.position.copy(at);
    controls.addEventListener("change", () => {
      this.onMove();
    });
    return controls;
  }

  /** Whether what is done over the picture is meant for it. */
  get #attended(): boolean {
    return !this.#polite || (document.hasFocus() && this.#canvas.matches(":focus"));
  }

  /** Orbit controls take all of it. */
  #shareTouch(): void {
    this.#canvas.style.touchAction = this.#attended ? "none" : "pan-y";
  }

  #onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const action = event.shiftKey ? (this.#panKeys[event.key] ?? this.#keys[event.key]) : this.#keys[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  readonly #keys: Record<string, () => void> = {
    ArrowLeft: () => {
      this.#controls.rotateLeft(ORBIT_STEP);
    },
    ArrowRight: () => {
      this.#controls.rotateLeft(-ORBIT_STEP);
    },
    ArrowUp: () => {
      this.#controls.rotateUp(ORBIT_STEP);
    },
    ArrowDown: () => {
      this.#controls.rotateUp(-ORBIT_STEP);
    },
    "+": () => {
      this.#controls.dollyIn(ZOOM_STEP);
    },
    "=": () => {
      this.#controls.dollyIn(ZOOM_STEP);
    },
    "-": () => {
      this.#controls.dollyOut(ZOOM_STEP);
    },
    "[": () => {
      this.onFieldOfView(1 / 1.08);
    },
    "]": () => {
      this.onFieldOfView(1.08);
    },
  };

  readonly #panKeys: Record<string, () => void> = {
    ArrowLeft: () => {
      this.#controls.pan(PAN_STEP, 0);
    },
    ArrowRight: () => {
      this.#controls.pan(-PAN_STEP, 0);
    },
    ArrowUp: () => {
      this.#controls.pan(0, PAN_STEP);
    },
    ArrowDown: () => {
      this.#controls.pan(0, -PAN_STEP);
    },
  };
}

/** Radians, a share of the distance, and pixels for each press of a key. */
const ORBIT_STEP = Math.PI / 36;
const ZOOM_STEP = 0.92;
const PAN_STEP = 24;
