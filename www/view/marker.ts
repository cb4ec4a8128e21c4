import {
  ConeGeometry,
  EdgesGeometry,
  LineBasicMaterial,
  LineSegments,
  type Object3D,
  type PerspectiveCamera,
  type Quaternion,
  type Vector3,
} from "three";
import type { Theme } from "./theme.ts";

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
