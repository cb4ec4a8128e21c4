import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Points,
  ShaderMaterial,
  Vector2,
  Vector3,
} from "three";
import { type Cloud, type Up, upVector } from "../cloud.ts";

/** What happens to the hidden points. */
export type HiddenMode = "off" | "dimmed" | "shown";

/** Where a file has no colors: from low to high, two calm tones that leave the shape to the shading. */
const LOW = new Color("#6f8796");
const HIGH = new Color("#efe6d6");
const GHOST = new Color("#8fa0b3");

/** How much of a hidden point covers what is in front of it. */
const OPACITY: Record<HiddenMode, number> = { off: 0, dimmed: 0.16, shown: 0.8 };

/** Device pixels: below, points flicker; above, one near point covers the view. */
const LEAST_PIXELS = 1.5;
const MOST_PIXELS = 48;

const vertexShader = /* glsl */ `
  /* The width of a point in the cloud's units, and how many pixels a unit has at distance 1. */
  uniform float width, pixels;
  /* Above 0: points are specks of so many pixels, however near. */
  uniform float speck;
  uniform vec3 up, low, high, ghost;
  uniform float halfHeight;
  uniform bool plain;
  varying vec3 tint;
  varying float size;
  #ifdef FILE_COLOR
    attribute vec3 color;
  #endif

  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    size = speck > 0.0 ? speck : clamp(width * pixels / gl_Position.w, ${LEAST_PIXELS.toFixed(1)}, ${MOST_PIXELS.toFixed(1)});
    gl_PointSize = size;
    #ifdef FILE_COLOR
      tint = color;
    #else
      tint = mix(low, high, clamp(dot(position, up) / halfHeight * 0.5 + 0.5, 0.0, 1.0));
    #endif
    if (plain) tint = ghost;
  }
`;

const fragmentShader = /* glsl */ `
  uniform float opacity;
  varying vec3 tint;
  varying float size;

  void main() {
    // Below three pixels a disc and a square look alike.
    if (size > 3.0 && length(gl_PointCoord - 0.5) > 0.5) discard;
    gl_FragColor = vec4(tint, opacity);
  }
`;

/**
 * The cloud as two draws of the same points: `solid` for the visible ones, `ghost` for the hidden ones. They share one
 * index buffer, written anew for each answer: first the visible points, then the hidden ones.
 *
 *      index   [ visible …… | hidden …………… ]
 *                solid ────   ghost ───────
 *
 * Points have no size of their own, so nothing of a cloud really covers anything: as long as the viewpoint goes with the
 * camera, hidden points are drawn through the visible ones. Seen from elsewhere, they stand where they are.
 */
export class CloudPoints {
  readonly solid: Points<BufferGeometry, ShaderMaterial>;
  readonly ghost: Points<BufferGeometry, ShaderMaterial>;
  private readonly cloud: Cloud;
  private readonly order: BufferAttribute;
  private readonly spacing: number;
  /** Whether the hidden points are drawn through the visible ones: as specks, for both to be seen. */
  private throughOthers = true;

  constructor(cloud: Cloud) {
    this.cloud = cloud;
    this.order = new BufferAttribute(Uint32Array.from({ length: cloud.count }, (_, i) => i), 1);
    this.order.setUsage(DynamicDrawUsage);
    this.spacing = roughSpacing(cloud);
    const position = new BufferAttribute(cloud.local, 3);
    const color = cloud.colors && new BufferAttribute(cloud.colors, 3, true);

    const draw = (isGhost: boolean) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", position);
      if (color) geometry.setAttribute("color", color);
      geometry.setIndex(this.order);
      const material = new ShaderMaterial({
        vertexShader,
        fragmentShader,
        defines: color ? { FILE_COLOR: "" } : {},
        transparent: isGhost,
        depthWrite: !isGhost,
        uniforms: {
          width: { value: 0 },
          pixels: { value: 1 },
          opacity: { value: 1 },
          plain: { value: false },
          speck: { value: 0 },
          up: { value: new Vector3(0, 1, 0) },
          halfHeight: { value: 1 },
          // Drawn as they are: the shading pass and the screen both take display colors.
          low: { value: display(LOW) },
          high: { value: display(HIGH) },
          ghost: { value: display(GHOST) },
        },
      });
      const points = new Points(geometry, material);
      points.frustumCulled = false;
      return points;
    };
    this.solid = draw(false);
    this.ghost = draw(true);
    this.solid.onBeforeRender = this.ghost.onBeforeRender = (renderer, _scene, camera) => {
      const height = renderer.getDrawingBufferSize(new Vector2()).y;
      this.set("pixels", (camera.projectionMatrix.elements[5] * height) / 2);
      this.ghost.material.uniforms["speck"]!.value = this.throughOthers ? renderer.getPixelRatio() : 0;
    };
    this.show("off", false);
  }

  /** The answer for a viewpoint: ascending indices of the visible points. */
  setVisible(indices: Uint32Array): void {
    const order = this.order.array as Uint32Array;
    order.set(indices);
    let at = indices.length;
    let next = 0;
    for (const index of indices) {
      while (next < index) order[at++] = next++;
      next = index + 1;
    }
    while (next < this.cloud.count) order[at++] = next++;
    this.order.needsUpdate = true;
    this.solid.geometry.setDrawRange(0, indices.length);
    this.ghost.geometry.setDrawRange(indices.length, this.cloud.count - indices.length);
  }

  show(mode: HiddenMode, frozen: boolean): void {
    const { material } = this.ghost;
    this.ghost.visible = mode !== "off";
    this.throughOthers = !frozen;
    material.depthTest = material.depthWrite = !this.throughOthers;
    material.uniforms["plain"]!.value = mode === "dimmed";
    material.uniforms["opacity"]!.value = frozen && mode === "shown" ? 1 : OPACITY[mode];
  }

  /** In multiples of the points' rough distance from one another; the width of a point in the cloud's units. */
  setPointSize(size: number): number {
    const width = size * this.spacing;
    this.set("width", width);
    return width;
  }

  setUp(up: Up): void {
    const direction = new Vector3(...upVector(up));
    const halfHeight = halfExtent(this.cloud.local, direction);
    this.set("up", direction);
    this.set("halfHeight", halfHeight);
  }

  private set(uniform: string, value: unknown): void {
    for (const { material } of [this.solid, this.ghost]) material.uniforms[uniform]!.value = value;
  }

  dispose(): void {
    for (const { geometry, material } of [this.solid, this.ghost]) {
      geometry.dispose();
      material.dispose();
    }
  }
}

/** As if the points lay evenly on the faces of their bounding box: near enough for a surface, and nothing to search. */
function roughSpacing({ size: [x, y, z], count }: Cloud): number {
  return Math.sqrt((2 * (x * y + y * z + z * x)) / count);
}

function halfExtent(local: Float32Array, direction: Vector3): number {
  let extent = 0;
  for (let i = 0; i < local.length; i += 3) {
    const height = local[i]! * direction.x + local[i + 1]! * direction.y + local[i + 2]! * direction.z;
    if (Math.abs(height) > extent) extent = Math.abs(height);
  }
  return extent > 0 ? extent : 1;
}

function display(color: Color): Color {
  return color.clone().convertLinearToSRGB();
}

