import { CameraHelper, Color, type Object3D, PerspectiveCamera, type Quaternion, Vector3 } from "three";
import type { Theme } from "./theme.ts";

/** Marks the frozen viewpoint: a small camera in the accent color. Its size is a fixed share of the cloud's. */
export class ViewpointMarker {
  readonly #parent: Object3D;
  #helper: CameraHelper | null = null;
  readonly #at = new Vector3();
  #size = 0;
  #color = new Color();

  constructor(parent: Object3D) {
    this.#parent = parent;
  }

  place(at: Vector3, direction: Quaternion, size: number): void {
    this.remove();
    const standing = new PerspectiveCamera(40, 1.4, size * 0.02, size);
    standing.position.copy(at);
    standing.quaternion.copy(direction);
    standing.updateMatrixWorld();
    this.#at.copy(at);
    this.#size = size;
    this.#helper = new CameraHelper(standing);
    this.#helper.visible = false;
    this.#paint();
    this.#parent.add(this.#helper);
  }

  setTheme({ accent }: Theme): void {
    this.#color = new Color(accent);
    this.#paint();
  }

  /** From inside the marker one would see nothing but its lines, so it is hidden there. */
  follow(camera: PerspectiveCamera): void {
    if (this.#helper) this.#helper.visible = camera.position.distanceTo(this.#at) > this.#size;
  }

  remove(): void {
    this.#helper?.removeFromParent();
    this.#helper?.dispose();
    this.#helper = null;
  }

  #paint(): void {
    const color = this.#color;
    this.#helper?.setColors(color, color, color, color, color);
  }
}
