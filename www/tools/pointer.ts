import type { Spot } from "./find.ts";
import type { Viewer } from "../view/viewer.ts";

/** A press that moves less than this, in pixels, is a click. */
const STILL = 5;
/** The largest distance of a point from a click. It is larger for touch, since fingers are wide. */
export const TOLERANCE = 8;
const TOUCH_TOLERANCE = 16;

/** Calls `click` for a click on the canvas. A drag is not a click: it turns the camera. */
export function onClick(canvas: HTMLElement, click: (spot: Spot) => void): void {
  let pressed: PointerEvent | null = null;
  canvas.addEventListener("pointerdown", (event) => {
    // A press with a second finger is not a click.
    pressed = event.isPrimary && event.button === 0 ? event : null;
  });
  canvas.addEventListener("pointerup", (event) => {
    const from = pressed;
    pressed = null;
    if (
      !from ||
      event.pointerId !== from.pointerId ||
      Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) > STILL
    ) {
      return;
    }
    click(spotOf(canvas, event, event.pointerType === "touch" ? TOUCH_TOLERANCE : TOLERANCE));
  });
}

/** The place of an event in the picture. */
export function spotOf(canvas: HTMLElement, { clientX, clientY }: MouseEvent, tolerance = TOLERANCE): Spot {
  const { left, top } = canvas.getBoundingClientRect();
  return { x: clientX - left, y: clientY - top, tolerance };
}

/** While `wanted`, drags on the canvas do not move the camera: the handlers get the path of each drag instead. */
export function onDrag(
  canvas: HTMLElement,
  wanted: () => boolean,
  handlers: {
    drag: (path: { x: number; y: number }[]) => void;
    end: (path: { x: number; y: number }[], event: PointerEvent) => void;
  },
): { cancel: () => boolean } {
  let path: { x: number; y: number }[] | null = null;
  const at = (event: PointerEvent) => {
    const { left, top } = canvas.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  };
  // In the capture phase, this handler gets the event before the orbit controls.
  canvas.addEventListener(
    "pointerdown",
    (event) => {
      if (!wanted() || event.button !== 0) return;
      event.stopImmediatePropagation();
      canvas.focus();
      if (!event.isPrimary) return;
      canvas.setPointerCapture(event.pointerId);
      path = [at(event)];
    },
    { capture: true },
  );
  canvas.addEventListener("pointermove", (event) => {
    if (!path || !event.isPrimary) return;
    path.push(at(event));
    handlers.drag(path);
  });
  canvas.addEventListener("pointerup", (event) => {
    if (!path || !event.isPrimary) return;
    const done = path;
    path = null;
    handlers.end(done, event);
  });
  const cancel = () => {
    const begun = path !== null;
    path = null;
    return begun;
  };
  canvas.addEventListener("pointercancel", cancel);
  return { cancel };
}

/** Lets tools wait until the picture is final: until then it is that of another place, or that of one hull. */
export class Patience {
  readonly #viewer: Viewer;
  #waiting: { run: () => void; from: string | null } | null = null;

  constructor(viewer: Viewer) {
    this.#viewer = viewer;
  }

  /** Runs something as soon as the picture is final. `here`: gives it up if the camera moves on before. */
  whenFinal(run: () => void, here = true): void {
    // Until the next frame, orbit controls leave the matrix of a moved camera half-way: at its new place, but not turned.
    this.#viewer.stage.camera.updateMatrixWorld();
    if (this.#viewer.isFinal) run();
    else this.#waiting = { run, from: here ? this.#camera : null };
  }

  /** Called every frame. */
  follow(): void {
    const waiting = this.#waiting;
    if (!waiting) return;
    if (waiting.from !== null && waiting.from !== this.#camera) {
      this.#waiting = null;
    } else if (this.#viewer.isFinal) {
      this.#waiting = null;
      waiting.run();
    }
  }

  /** Gives everything up. */
  clear(): void {
    this.#waiting = null;
  }

  get #camera(): string {
    return this.#viewer.stage.camera.matrixWorld.elements.join();
  }
}
