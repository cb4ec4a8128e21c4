import {
  BufferAttribute,
  BufferGeometry,
  LineSegments,
  type Object3D,
  type PerspectiveCamera,
  type Quaternion,
  ShaderMaterial,
  Vector3,
} from "three";
import { display, type Theme } from "./theme.ts";

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

/** The lines of a small camera at the origin that looks along −z: what it sees up to distance 1, and a sign above. */
function cameraLines(): Float32Array {
  const [wide, high] = [0.51, 0.364];
  const corners = [
    [-wide, -high],
    [wide, -high],
    [wide, high],
    [-wide, high],
  ] as const;
  const lines = corners.flatMap(([x, y], i) => {
    const [nextX, nextY] = corners[(i + 1) % 4]!;
    return [0, 0, 0, x, y, -1, x, y, -1, nextX, nextY, -1];
  });
  const [low, top] = [1.1 * high, 1.9 * high];
  const roof = [-0.6 * wide, low, -1, 0.6 * wide, low, -1, 0, top, -1];
  const [a, b, c] = [roof.slice(0, 3), roof.slice(3, 6), roof.slice(6)];
  return Float32Array.from([...lines, ...a, ...b, ...b, ...c, ...c, ...a]);
}

/** Marks the frozen viewpoint: a small camera in the accent color. Its size is a fixed share of the cloud's. */
export class ViewpointMarker {
  readonly #parent: Object3D;
  #lines: LineSegments<BufferGeometry, ShaderMaterial> | null = null;
  readonly #at = new Vector3();
  #size = 0;
  readonly #material = new ShaderMaterial({ vertexShader, fragmentShader, uniforms: { color: { value: null } } });

  constructor(parent: Object3D) {
    this.#parent = parent;
  }

  place(at: Vector3, direction: Quaternion, size: number): void {
    this.remove();
    this.#at.copy(at);
    this.#size = size;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(cameraLines(), 3));
    this.#lines = new LineSegments(geometry, this.#material);
    this.#lines.position.copy(at);
    this.#lines.quaternion.copy(direction);
    this.#lines.scale.setScalar(size);
    this.#lines.visible = false;
    this.#parent.add(this.#lines);
  }

  setTheme({ accent }: Theme): void {
    this.#material.uniforms["color"]!.value = display(accent);
  }

  /** From inside the marker one would see nothing but its lines, so it is hidden there. */
  follow(camera: PerspectiveCamera): void {
    if (this.#lines) this.#lines.visible = camera.position.distanceTo(this.#at) > this.#size;
  }

  remove(): void {
    this.#lines?.removeFromParent();
    this.#lines?.geometry.dispose();
    this.#lines = null;
  }
}
