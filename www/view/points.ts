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
import type { VisibilityMap } from "hidden-point-removal";
import type { Cloud } from "../cloud/cloud.ts";
import { TOUCHING_FROM } from "../settings/limits.ts";
import type { HiddenMode } from "../settings/settings.ts";
import { type CloudAttributes, display } from "./attributes.ts";
import { fragmentShader, MOST_PIXELS, vertexShader } from "./point-shaders.ts";
import type { Theme } from "./theme.ts";

/** The share of a hidden point's own color that the theme's color for hidden points covers. */
const COVERAGE = 0.85;

/** The greatest width of a hidden point, in spacings: it must not look like a surface. */
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
  #width = 0;
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
    this.#spacing = roughSpacing(cloud);

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
        const kind = this.#width < TOUCHING_FROM * this.#spacing ? "small" : "touching";
        uniforms["most"]!.value = MOST_PIXELS[kind] * renderer.getPixelRatio();
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
    this.#setWidths();
  }

  setTheme(theme: Theme): void {
    this.#theme = theme;
    this.ghost.material.uniforms["cover"]!.value = display(this.#ghostly ? theme.hiddenDimmed : theme.hidden);
  }

  /** Takes multiples of the rough distance between neighbors. Returns the width of a point in the cloud's units. */
  setPointSize(size: number): number {
    this.#width = size * this.#spacing;
    this.#setWidths();
    return this.#width;
  }

  #setWidths(): void {
    for (const { material } of this.#draws) material.uniforms["width"]!.value = this.#width;
    this.ghost.material.uniforms["width"]!.value = Math.min(this.#width, HIDDEN_WIDTH * this.#spacing);
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
 * The distance between neighbors if the points were spread evenly over the faces of their bounding box. It is good
 * enough for a surface, and needs no search.
 */
function roughSpacing({ size, body, count, among = count }: Cloud): number {
  const [x, y, z] = body?.size ?? size;
  return Math.sqrt((2 * (x * y + y * z + z * x)) / among);
}

/**
 * The least width of a point in pixels. If there are few points, it is larger, so that they can be found. In a narrow
 * picture it is smaller, so that points do not cover one another.
 */
function leastPixels(count: number, width: number): number {
  return count < 100 ? 6 : count < 1000 ? 3 : Math.min(1.5, Math.max(1, width / 700));
}
