import { isKeyOf } from "../controls/keys.ts";
import { includes, pointAt } from "../tools/find.ts";
import { onClick, TOLERANCE } from "../tools/pointer.ts";
import { project } from "../view/viewer.ts";
import type { Viewer } from "../view/viewer.ts";
import type { PickedPoint, Place } from "./api.ts";

interface Options {
  through?: boolean;
  tolerance?: number;
}

/**
 * Finds the point at a place of the pointer, and the place of a point. Places are in client coordinates. Without a
 * cloud there are no points.
 */
export class Pointing {
  readonly #canvas: HTMLCanvasElement;
  readonly #viewer: Viewer;

  constructor(canvas: HTMLCanvasElement, viewer: Viewer) {
    this.#canvas = canvas;
    this.#viewer = viewer;
  }

  pick(clientX: number, clientY: number, { through = false, tolerance = TOLERANCE }: Options = {}): PickedPoint | null {
    if (![clientX, clientY, tolerance].every(Number.isFinite)) throw new TypeError("expected finite numbers");
    if (!this.#viewer.cloud) return null;
    const { left, top, scale } = this.#frame;
    const index = pointAt(
      this.#viewer,
      { x: (clientX - left) / scale, y: (clientY - top) / scale, tolerance },
      through,
    );
    return index === null ? null : this.#point(index);
  }

  project(position: Place): { x: number; y: number } | null {
    const at = this.#viewer.cloud && project(this.#viewer, position);
    const { left, top, scale } = this.#frame;
    return at && { x: left + at.x * scale, y: top + at.y * scale };
  }

  /** Calls `tell` for a visible point that is clicked. Enter counts as a click on the middle of the picture. */
  onPick(tell: (point: PickedPoint) => void): void {
    const at = (x: number, y: number, tolerance: number) => {
      const index = this.#viewer.cloud ? pointAt(this.#viewer, { x, y, tolerance }, false) : null;
      if (index !== null) tell(this.#point(index));
    };
    onClick(this.#canvas, ({ x, y, tolerance }) => {
      const { scale } = this.#frame;
      at(x / scale, y / scale, tolerance);
    });
    this.#canvas.addEventListener("keydown", (event) => {
      const { width, height } = this.#viewer.stage.size;
      if (isKeyOf("middle", event) && !event.repeat) at(width / 2, height / 2, TOLERANCE);
    });
  }

  /** Where the picture is, and its scale: the page may have scaled the element. */
  get #frame(): { left: number; top: number; scale: number } {
    const { left, top, width } = this.#canvas.getBoundingClientRect();
    return { left, top, scale: width / this.#canvas.clientWidth || 1 };
  }

  #point(index: number): PickedPoint {
    const { positions, visible } = this.#viewer.scene;
    const position = [0, 1, 2].map((axis) => positions[3 * index + axis]!) as Place;
    return { index, position, visible: includes(visible, index) };
  }
}
