import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Points, ShaderMaterial, Vector2 } from "three";
import type { Cloud } from "../cloud.ts";
import type { HiddenMode } from "../settings.ts";
import { type CloudAttributes, display, TINT_SHADER } from "./attributes.ts";
import type { Theme } from "./theme.ts";

/** How much of the theme's color for hidden points covers their own. */
const COVERAGE = 0.7;

/** How much is seen of hidden points that are drawn through the visible ones, and how wide they are at most, in spacings. */
export const THROUGH_OPACITY: Record<HiddenMode, number> = { off: 0, dimmed: 0.4, shown: 0.85 };
const THROUGH_WIDTH = 0.45;

/** Device pixels: above, one near point covers the view. */
const MOST_PIXELS = 160;
/** Device pixels: further to the right than any picture goes. */
const EVERYWHERE = 1e9;

const vertexShader = /* glsl */ `
  ${TINT_SHADER}
  /* The width of a point in the cloud's units, and how many pixels a unit has at distance 1. */
  uniform float width, pixels;
  /* The least pixels of a point: below, it flickers. */
  uniform float least;
  uniform vec3 cover;
  uniform float coverage;
  varying vec3 tint;
  varying float size;

  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    size = clamp(width * pixels / gl_Position.w, least, ${MOST_PIXELS.toFixed(1)});
    gl_PointSize = size;
    // Hidden points have no light of their own.
    tint = chosenOr(coverage > 0.0 ? mix(ownTint(), cover, coverage) : ownTint() * light());
  }
`;

const fragmentShader = /* glsl */ `
  uniform float until;
  varying vec3 tint;
  varying float size;

  void main() {
    if (gl_FragCoord.x > until) discard;
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
  private theme: Theme;
  private dimmed = false;
  private width = 0;
  /** Whether the hidden points are drawn through the visible ones: as specks, for both to be seen. */
  private throughOthers = true;
  /** The share of the picture's width, from its left, that hidden points are drawn in. */
  private until = 1;

  constructor(cloud: Cloud, attributes: CloudAttributes, theme: Theme) {
    this.cloud = cloud;
    this.theme = theme;
    this.order = new BufferAttribute(Uint32Array.from({ length: cloud.count }, (_, i) => i), 1);
    this.order.setUsage(DynamicDrawUsage);
    this.spacing = roughSpacing(cloud);

    const draw = () => {
      const geometry = new BufferGeometry();
      attributes.addTo(geometry);
      geometry.setIndex(this.order);
      const material = new ShaderMaterial({
        vertexShader,
        fragmentShader,
        uniforms: {
          ...attributes.uniforms,
          width: { value: 0 },
          pixels: { value: 1 },
          least: { value: 1 },
          cover: { value: display(theme.hidden) },
          coverage: { value: 0 },
          until: { value: EVERYWHERE },
        },
      });
      const points = new Points(geometry, material);
      points.frustumCulled = false;
      return points;
    };
    this.solid = draw();
    this.ghost = draw();
    this.solid.onBeforeRender = this.ghost.onBeforeRender = (renderer, _scene, camera) => {
      const { x: width, y: height } = renderer.getDrawingBufferSize(new Vector2());
      const pixels = (camera.projectionMatrix.elements[5] * height) / 2;
      for (const { material } of [this.solid, this.ghost]) material.uniforms["pixels"]!.value = pixels;
      this.ghost.material.uniforms["until"]!.value = this.until * width;
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

  /** Hidden points, and up to which share of the picture's width. */
  show(mode: HiddenMode, frozen: boolean, until = 1): void {
    const { uniforms } = this.ghost.material;
    this.until = until;
    this.ghost.visible = mode !== "off";
    this.throughOthers = !frozen;
    uniforms["coverage"]!.value = COVERAGE;
    this.dimmed = frozen && mode === "dimmed";
    this.setTheme(this.theme);
    this.setWidths();
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.ghost.material.uniforms["cover"]!.value = display(this.dimmed ? theme.hiddenDimmed : theme.hidden);
  }

  /** In multiples of the points' rough distance from one another; the width of a point in the cloud's units. */
  setPointSize(size: number): number {
    this.width = size * this.spacing;
    this.setWidths();
    return this.width;
  }

  private setWidths(): void {
    this.solid.material.uniforms["width"]!.value = this.width;
    this.ghost.material.uniforms["width"]!.value = this.throughOthers ? Math.min(this.width, THROUGH_WIDTH * this.spacing) : this.width;
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

/** Few points are drawn large enough to be found. */
function leastPixels(count: number): number {
  return count < 100 ? 6 : count < 1000 ? 3 : 1.5;
}
