import { BufferAttribute, BufferGeometry, Group, Points, ShaderMaterial, Vector2, Vector3 } from "three";
import type { Up } from "../cloud/cloud.ts";
import { upVector } from "../cloud/cloud.ts";
import { display } from "./attributes.ts";
import { findHome } from "./framing.ts";
import type { Navigation } from "./navigation.ts";
import type { Stage } from "./stage.ts";
import type { Theme } from "./theme.ts";

const vertexShader = /* glsl */ `
  uniform vec3 up, low, high;
  uniform vec2 heights;
  uniform float size;
  varying vec3 tint;

  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    gl_PointSize = size;
    tint = mix(low, high, clamp((dot(position, up) - heights.x) / max(heights.y - heights.x, 1e-30), 0.0, 1.0));
  }
`;

const fragmentShader = /* glsl */ `
  varying vec3 tint;
  void main() {
    gl_FragColor = vec4(tint, 1.0);
  }
`;

/** The width of a point in CSS pixels. The distance between the points is not known yet. */
const WIDTH = 1.5;

/** The points of a file as far as they have been read, in the middle of the picture. */
export class Preview {
  readonly #stage: Stage;
  readonly #navigation: Navigation;
  readonly #up: Up;
  readonly #group = new Group();
  readonly #geometries: BufferGeometry[] = [];
  readonly #material: ShaderMaterial;
  readonly #low = new Vector3(Infinity, Infinity, Infinity);
  readonly #high = new Vector3(-Infinity, -Infinity, -Infinity);
  /** Where the camera was put. If the user moves it, it stays there. */
  #at: Vector3 | null = null;

  constructor(stage: Stage, navigation: Navigation, theme: Theme, up: Up) {
    this.#stage = stage;
    this.#navigation = navigation;
    this.#up = up;
    this.#material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: {
        up: { value: new Vector3(...upVector(up)) },
        low: { value: display(theme.low) },
        high: { value: display(theme.high) },
        heights: { value: new Vector2() },
        size: { value: WIDTH * stage.pixelRatio },
      },
    });
    stage.all.add(this.#group);
    stage.setPointWidth(0);
    stage.setAll({ opacity: 1, alone: 0 });
  }

  /** Adds points. Their coordinates are measured from the same place for all of them. */
  add(points: Float32Array): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(points, 3));
    this.#geometries.push(geometry);
    const drawn = new Points(geometry, this.#material);
    drawn.frustumCulled = false;
    this.#group.add(drawn);
    const point = new Vector3();
    for (let i = 0; i < points.length; i += 3) {
      point.fromArray(points, i);
      // A point may have no position.
      if (!Number.isFinite(point.x + point.y + point.z)) continue;
      this.#low.min(point);
      this.#high.max(point);
    }
    this.#frame();
    this.#stage.invalidate();
  }

  dispose(): void {
    this.#group.removeFromParent();
    for (const geometry of this.#geometries) geometry.dispose();
    this.#material.dispose();
  }

  /** Puts all points so far into the picture. */
  #frame(): void {
    const { camera } = this.#stage;
    const up = new Vector3(...upVector(this.#up));
    const ends = [this.#low.dot(up), this.#high.dot(up)];
    (this.#material.uniforms["heights"]!.value as Vector2).set(Math.min(...ends), Math.max(...ends));
    if (this.#low.x > this.#high.x || (this.#at && !camera.position.equals(this.#at))) return;
    const half = this.#high.clone().sub(this.#low).divideScalar(2);
    this.#group.position.copy(this.#low).add(half).negate();
    const local = new Float32Array(24);
    for (let corner = 0; corner < 8; corner++) {
      for (let axis = 0; axis < 3; axis++) {
        local[3 * corner + axis] = (corner >> axis) & 1 ? half.getComponent(axis) : -half.getComponent(axis);
      }
    }
    const radius = half.length() || 1;
    const box = {
      count: 8,
      colors: null,
      attributes: [],
      fields: [],
      facts: {},
      origin: null,
      center: [0, 0, 0] as [number, number, number],
      local,
      radius,
      body: null,
    };
    const size = half.multiplyScalar(2).toArray();
    const { pose, extent } = findHome({ ...box, size }, this.#up, null, null, {
      fov: camera.fov,
      ...this.#stage.shape,
    });
    this.#navigation.setHome(pose);
    this.#at = pose.at.clone();
    this.#stage.setExtent(extent);
  }
}
