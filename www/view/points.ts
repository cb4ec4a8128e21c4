import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  DynamicDrawUsage,
  FloatType,
  Points,
  RedFormat,
  ShaderMaterial,
  Vector2,
  Vector3,
  Vector4,
} from "three";
import { VisibilityMap } from "hidden-point-removal";
import type { Cloud } from "../cloud/cloud.ts";
import type { HiddenMode } from "../settings/settings.ts";
import { LOCAL_SPACING } from "../cloud/spacing.ts";
import { type CloudAttributes, display, TINT_SHADER } from "./attributes.ts";
import type { Theme } from "./theme.ts";

/** The greatest width of a point in pixels: a wider one would be a balloon. */
export const MOST_PIXELS = 160;
/** Of all points, which are small and bright, so that what lies behind them shows. */
const MOST_SMALL = 2.5;
/** Discs of this many spacings cover a surface. With less, what lies behind shows. */
const COVERING = 2;
/** The width of one of all points, in spacings. */
const SMALL = 0.35;

const vertexShader = /* glsl */ `
  ${TINT_SHADER}
  /* The width of a point in the cloud's units where it is typical, and the length of a unit at distance 1 in pixels. */
  uniform float width, pixels;
  /* The least width of a point in pixels: a smaller one flickers. The greatest one: a wider one would be a balloon. */
  uniform float least, most;
  uniform vec3 cover;
  uniform float coverage;
  /* 0: all points are drawn. 1: those that the map does not hide. -1: those that it hides. */
  uniform float byMap;
  /* The part of the picture that is shown, from left to right in clip space, and the width of a pixel there. */
  uniform vec3 part;
  ${VisibilityMap.prototype.glsl}
  varying vec3 tint;
  varying float size;

  void main() {
    if (byMap != 0.0 && (byMap > 0.0) == hidden(position)) {
      gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      gl_PointSize = 0.0;
      return;
    }
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    size = clamp(width * ${LOCAL_SPACING} * pixels / gl_Position.w, least, max(least, most));
    gl_PointSize = size;
    // Far beyond the dividing line, nobody sees the point, nor its shade.
    float x = gl_Position.x / gl_Position.w;
    float near = (size + 16.0) * part.z;
    if (gl_Position.w > 0.0 && (x < part.x - near || x > part.y + near)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    tint = chosenOr(mix(ownTint(), cover, coverage));
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

/** The share of a hidden point's own color that the theme's color for hidden points covers. */
const COVERAGE = 0.85;

/** The width of a hidden point, in spacings: it must not look like a surface. */
const HIDDEN_WIDTH = 0.45;

type Draw = Points<BufferGeometry, ShaderMaterial>;

/**
 * The cloud in several draws of the same points: `solid` for the visible ones, `ghost` for the hidden ones. They share one
 * index buffer, which is written for each answer: first the visible points, then the hidden ones, if these are drawn.
 *
 *      index   [ visible …… | hidden …………… ]
 *                solid ────   ghost ───────
 *
 * While the camera moves, both draw all points without an index, and the vertex shader leaves out points by a map.
 */
export class CloudPoints {
  readonly solid: Draw;
  readonly ghost: Draw;
  /** All points, whatever the answer is, as any viewer shows them. */
  readonly all: Draw;
  readonly #order: BufferAttribute;
  readonly #spacing: number;
  readonly #draws: Draw[];
  #theme: Theme;
  #ghostly = false;
  #visible: Uint32Array = new Uint32Array();
  /** The uniforms of a map, shared by all draws. */
  readonly #map = {
    hprDepths: { value: null as DataTexture | null },
    hprViewpoint: { value: new Vector3() },
    hprMargins: { value: new Vector4() },
  };
  #hiddenListed = true;

  constructor(cloud: Cloud, attributes: CloudAttributes, theme: Theme) {
    this.#theme = theme;
    this.#order = new BufferAttribute(new Uint32Array(cloud.count), 1);
    this.#order.setUsage(DynamicDrawUsage);
    this.#spacing = cloud.spacing.typical;

    const draw = (coverage: number, order: BufferAttribute | null = this.#order) => {
      const geometry = new BufferGeometry();
      attributes.addTo(geometry);
      geometry.setIndex(order);
      const material = new ShaderMaterial({
        vertexShader,
        fragmentShader,
        uniforms: {
          ...attributes.uniforms,
          width: { value: 0 },
          pixels: { value: 1 },
          least: { value: 1 },
          most: { value: 1 },
          cover: { value: new Color() },
          coverage: { value: coverage },
          byMap: { value: 0 },
          part: { value: new Vector3(-1, 1, 0) },
          ...this.#map,
        },
      });
      const points = new Points(geometry, material);
      points.frustumCulled = false;
      return points;
    };
    this.solid = draw(0);
    this.ghost = draw(COVERAGE);
    this.all = draw(0, null);
    this.#draws = [this.solid, this.ghost, this.all];
    for (const each of this.#draws) {
      each.onBeforeRender = (renderer, scene, camera) => {
        const { x: width, y: height } = renderer.getDrawingBufferSize(new Vector2());
        const { uniforms } = each.material;
        const [from, to] = scene.userData["part"] as [number, number];
        (uniforms["part"]!.value as Vector3).set(2 * from - 1, 2 * to - 1, 2 / width);
        uniforms["pixels"]!.value = (camera.projectionMatrix.elements[5] * height) / 2;
        const least = leastPixels(cloud.count, width / renderer.getPixelRatio()) * renderer.getPixelRatio();
        uniforms["most"]!.value = (each === this.all ? MOST_SMALL : MOST_PIXELS) * renderer.getPixelRatio();
        // Visible points look solid beside all points, whose far side shows between them.
        const share = each === this.ghost ? 1 / 1.5 : each === this.solid ? 1.2 : 1 / 1.2;
        uniforms["least"]!.value = share * least;
      };
    }
    this.show("off");
  }

  /** The answer for a viewpoint: ascending indices of the visible points. */
  setVisible(indices: Uint32Array): void {
    this.#visible = indices;
    this.#order.clearUpdateRanges();
    (this.#order.array as Uint32Array).set(indices);
    this.#upload(0, indices.length);
    this.#drawBy(0);
    this.solid.geometry.setDrawRange(0, indices.length);
    this.ghost.geometry.setDrawRange(indices.length, this.#order.count - indices.length);
    this.#hiddenListed = false;
    if (this.ghost.visible) this.#listHidden();
  }

  /** Leaves out points by a map, until the next answer. Its positions are relative to the middle of the cloud. */
  setMap({ data, uniforms }: VisibilityMap): void {
    this.#map.hprDepths.value?.dispose();
    const isEmpty = data.length === 0;
    const texture = isEmpty ? null : new DataTexture(data, 256, data.length / 256, RedFormat, FloatType);
    if (texture !== null) texture.needsUpdate = true;
    this.#map.hprDepths.value = texture;
    this.#map.hprViewpoint.value.fromArray(uniforms.hprViewpoint);
    this.#map.hprMargins.value.fromArray(uniforms.hprMargins);
    this.#drawBy(isEmpty ? 0 : 1, null);
    for (const { geometry } of [this.solid, this.ghost]) geometry.setDrawRange(0, this.#order.count);
    if (isEmpty) this.ghost.geometry.setDrawRange(0, 0);
  }

  #drawBy(mode: 0 | 1, order: BufferAttribute | null = this.#order): void {
    for (const draw of [this.solid, this.ghost]) {
      draw.geometry.setIndex(order);
      draw.material.uniforms["byMap"]!.value = draw === this.solid ? mode : -mode;
    }
  }

  #listHidden(): void {
    this.#hiddenListed = true;
    const visible = this.#visible;
    const order = this.#order.array as Uint32Array;
    let at = visible.length;
    let next = 0;
    for (let i = 0; i < visible.length; i++) {
      const index = visible[i]!;
      while (next < index) order[at++] = next++;
      next = index + 1;
    }
    while (next < order.length) order[at++] = next++;
    this.#upload(visible.length, order.length);
  }

  /** Sends a range of the order to the graphics card. Then three.js forgets the range. */
  #upload(from: number, to: number): void {
    this.#order.addUpdateRange(from, to - from);
    this.#order.needsUpdate = true;
  }

  show(mode: HiddenMode): void {
    this.ghost.visible = mode !== "off";
    if (this.ghost.visible && !this.#hiddenListed) this.#listHidden();
    this.#ghostly = mode === "dimmed";
    this.setTheme(this.#theme);
  }

  setTheme(theme: Theme): void {
    this.#theme = theme;
    this.ghost.material.uniforms["cover"]!.value = display(this.#ghostly ? theme.hiddenDimmed : theme.hidden);
  }

  /**
   * `size`: 1 for points that touch. `through`: the visible points are small, so that the hidden ones behind them show.
   * Returns the width of a typical point in the cloud's units.
   */
  setPointSize(size: number, through: boolean): number {
    const set = (draw: Draw, spacings: number) => (draw.material.uniforms["width"]!.value = spacings * this.#spacing);
    set(this.ghost, HIDDEN_WIDTH);
    set(this.all, SMALL);
    return set(this.solid, (through ? SMALL : COVERING) * size);
  }

  dispose(): void {
    this.#map.hprDepths.value?.dispose();
    for (const { geometry, material } of this.#draws) {
      geometry.dispose();
      material.dispose();
    }
  }
}

/**
 * The least width of a point in pixels. If there are few points, it is larger, so that they can be found. In a narrow
 * picture it is smaller, so that points do not cover one another.
 */
function leastPixels(count: number, width: number): number {
  return count < 100 ? 6 : count < 1000 ? 3 : Math.min(1.5, Math.max(1, width / 700));
}
