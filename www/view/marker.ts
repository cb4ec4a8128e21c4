import {
  CameraHelper,
  type LineBasicMaterial,
  type Object3D,
  PerspectiveCamera,
  type Quaternion,
  ShaderMaterial,
  Vector3,
} from "three";
import { display } from "./attributes.ts";
import type { Theme } from "./theme.ts";

const vertexShader = /* glsl */ `
  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }
`;

const fragmentShader = /* glsl */ `
  uniform vec3 color;
  void main() {
    gl_FragColor = vec4(color, 1.0);
  }
`;

/** Marks the frozen viewpoint: a small camera in the accent color. Its size is a fixed share of the cloud's. */
export class ViewpointMarker {
  readonly #parent: Object3D;
  #helper: CameraHelper | null = null;
  readonly #at = new Vector3();
  #size = 0;
  // The page has no shaders of three.js's own materials (build/three-plugin.ts).
  readonly #material = new ShaderMaterial({ vertexShader, fragmentShader, uniforms: { color: { value: null } } });

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
    (this.#helper.material as LineBasicMaterial).dispose();
    this.#helper.material = this.#material;
    this.#helper.visible = false;
    this.#parent.add(this.#helper);
  }

  setTheme({ accent }: Theme): void {
    this.#material.uniforms["color"]!.value = display(accent);
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
}
