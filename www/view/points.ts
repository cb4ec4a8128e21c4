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
/** Hidden points have a hue of their own; dimmed ones are a dark neutral where nothing stands before them. */
const HIDDEN = new Color("#a9599c");
const HIDDEN_DIMMED = new Color("#4a515c");
/** How much of that color covers a hidden point's own. */
const COVERAGE = 0.7;

/** How much is seen of hidden points that are drawn through the visible ones, and how wide they are at most, in spacings. */
export const THROUGH_OPACITY: Record<HiddenMode, number> = { off: 0, dimmed: 0.4, shown: 0.85 };
const THROUGH_WIDTH = 0.45;

/** Device pixels: above, one near point covers the view. */
const MOST_PIXELS = 160;
/** The share of the points below and above which heights have the ramp's first and last color. */
const RAMP_FROM = 0.01;
const RAMP_SAMPLE = 20_000;

const vertexShader = /* glsl */ `
  /* The width of a point in the cloud's units, and how many pixels a unit has at distance 1. */
  uniform float width, pixels;
  /* The least pixels of a point: below, it flickers. */
  uniform float least;
  uniform vec3 up, low, high, cover;
  uniform vec2 heights;
  uniform float coverage;
  varying vec3 tint;
  varying float size;
  #ifdef FILE_COLOR
    attribute vec3 color;
  #endif

  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    size = clamp(width * pixels / gl_Position.w, least, ${MOST_PIXELS.toFixed(1)});
    gl_PointSize = size;
    #ifdef FILE_COLOR
      tint = color;
    #else
      tint = mix(low, high, clamp((dot(position, up) - heights.x) / (heights.y - heights.x), 0.0, 1.0));
    #endif
    tint = mix(tint, cover, coverage);
  }
`;

const fragmentShader = /* glsl */ `
  varying vec3 tint;
  varying float size;

  void main() {
    // Below three pixels a disc and a square look alike.
    if (size > 3.0 && length(gl_PointCoord - 0.5) > 0.5) discard;
    gl_FragColor = vec4(tint, 1.0);
  }
`;

/**
 * The cloud as two draws of the same points: `solid` for the visible ones, `ghost` for the hidden ones. They share one
 * index buffer, written anew for each answer: first the visible points, then the hidden ones.
 *
 *      index   [ visible …… | hidden …………… ]
 *                solid ────   ghost ───────
 */
export class CloudPoints {
  readonly solid: Points<BufferGeometry, ShaderMaterial>;
  readonly ghost: Points<BufferGeometry, ShaderMaterial>;
  private readonly cloud: Cloud;
  private readonly order: BufferAttribute;
  private readonly spacing: number;
  private width = 0;
  /** Whether the hidden points are drawn through the visible ones: as specks, for both to be seen. */
  private throughOthers = true;

  constructor(cloud: Cloud) {
    this.cloud = cloud;
    this.order = new BufferAttribute(Uint32Array.from({ length: cloud.count }, (_, i) => i), 1);
    this.order.setUsage(DynamicDrawUsage);
    this.spacing = roughSpacing(cloud);
    const position = new BufferAttribute(cloud.local, 3);
    const color = cloud.colors && new BufferAttribute(cloud.colors, 3, true);

    const draw = () => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", position);
      if (color) geometry.setAttribute("color", color);
      geometry.setIndex(this.order);
      const material = new ShaderMaterial({
        vertexShader,
        fragmentShader,
        defines: color ? { FILE_COLOR: "" } : {},
        uniforms: {
          width: { value: 0 },
          pixels: { value: 1 },
          least: { value: 1 },
          up: { value: new Vector3(0, 1, 0) },
          heights: { value: new Vector2(-1, 1) },
          // Drawn as they are: the shading pass and the screen both take display colors.
          low: { value: display(LOW) },
          high: { value: display(HIGH) },
          cover: { value: display(HIDDEN) },
          coverage: { value: 0 },
        },
      });
      const points = new Points(geometry, material);
      points.frustumCulled = false;
      return points;
    };
    this.solid = draw();
    this.ghost = draw();
    this.solid.onBeforeRender = this.ghost.onBeforeRender = (renderer, _scene, camera) => {
      const height = renderer.getDrawingBufferSize(new Vector2()).y;
      this.set("pixels", (camera.projectionMatrix.elements[5] * height) / 2);
      const least = leastPixels(cloud.count) * renderer.getPixelRatio();
      this.solid.material.uniforms["least"]!.value = least;
      this.ghost.material.uniforms["least"]!.value = this.throughOthers ? least / 1.5 : least;
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
    const { uniforms } = this.ghost.material;
    this.ghost.visible = mode !== "off";
    this.throughOthers = !frozen;
    uniforms["cover"]!.value = display(frozen && mode === "dimmed" ? HIDDEN_DIMMED : HIDDEN);
    uniforms["coverage"]!.value = COVERAGE;
    this.setWidths();
  }

  /** In multiples of the points' rough distance from one another; the width of a point in the cloud's units. */
  setPointSize(size: number): number {
    this.width = size * this.spacing;
    this.setWidths();
    return this.width;
  }

  setUp(up: Up): void {
    const direction = new Vector3(...upVector(up));
    this.set("up", direction);
    this.set("heights", rampHeights(this.cloud.local, direction));
  }

  private setWidths(): void {
    this.solid.material.uniforms["width"]!.value = this.width;
    this.ghost.material.uniforms["width"]!.value = this.throughOthers ? Math.min(this.width, THROUGH_WIDTH * this.spacing) : this.width;
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

/** The heights between which the colors run: not from the lowest to the highest point, or a few strays would take the ramp. */
function rampHeights(local: Float32Array, direction: Vector3): Vector2 {
  const step = 3 * Math.ceil(local.length / 3 / RAMP_SAMPLE);
  const heights: number[] = [];
  for (let i = 0; i < local.length; i += step) {
    heights.push(local[i]! * direction.x + local[i + 1]! * direction.y + local[i + 2]! * direction.z);
  }
  heights.sort((a, b) => a - b);
  const at = (share: number) => heights[Math.round(share * (heights.length - 1))]!;
  const [low, high] = [at(RAMP_FROM), at(1 - RAMP_FROM)];
  return high > low ? new Vector2(low, high) : new Vector2(low - 1, low + 1);
}

/** Few points are drawn large enough to be found. */
function leastPixels(count: number): number {
  return count < 100 ? 6 : count < 1000 ? 3 : 1.5;
}

function display(color: Color): Color {
  return color.clone().convertLinearToSRGB();
}
