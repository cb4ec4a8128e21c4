import { BufferAttribute, type BufferGeometry, Color, DynamicDrawUsage, Sphere, Vector2, Vector3 } from "three";
import { type Cloud, type Up, upVector } from "../cloud/cloud.ts";
import { spreadOf } from "../cloud/spacing.ts";
import type { Theme } from "./theme.ts";

/** The share of a selected point's own color that is covered. */
const CHOSEN_COVERAGE = 0.65;

/** The text before the `main` of a vertex shader: the color of a vertex. */
export const TINT_SHADER = /* glsl */ `
  uniform vec3 up, low, high;
  uniform vec2 heights;
  uniform bool colored;
  uniform vec3 chosenColor;
  attribute float chosen;
  attribute vec3 color;
  attribute float spread;

  vec3 ownTint() {
    if (colored) return color;
    return mix(low, high, clamp((dot(position, up) - heights.x) / (heights.y - heights.x), 0.0, 1.0));
  }

  vec3 chosenOr(vec3 tint) {
    return mix(tint, chosenColor, ${CHOSEN_COVERAGE.toFixed(2)} * chosen);
  }
`;

/** Places and colors, which the draws of a cloud share on the graphics card. */
export class CloudAttributes {
  /** Shared by all materials of the cloud. */
  readonly uniforms = {
    up: { value: new Vector3(0, 1, 0) },
    heights: { value: new Vector2(-1, 1) },
    // The colors are not converted, because the shading pass and the screen both take display colors.
    low: { value: new Color() },
    high: { value: new Color() },
    chosenColor: { value: new Color() },
    colored: { value: false },
  };
  readonly #local: Float32Array;
  readonly #bounds: Sphere;
  readonly #geometries: BufferGeometry[] = [];
  readonly #position: BufferAttribute;
  readonly #spread: BufferAttribute;
  readonly #ownColors: Uint8Array | null;
  #color: BufferAttribute | null = null;
  #chosen: BufferAttribute | null = null;

  constructor({ local, colors, radius, spacing }: Cloud, theme: Theme) {
    this.#local = local;
    this.#bounds = new Sphere(new Vector3(), radius);
    this.#position = new BufferAttribute(local, 3);
    this.#spread = new BufferAttribute(spacing.local, 1, true);
    this.#ownColors = colors;
    this.setTints(null);
    this.setTheme(theme);
  }

  setTheme({ low, high, chosen }: Theme): void {
    this.uniforms.low.value = display(low);
    this.uniforms.high.value = display(high);
    this.uniforms.chosenColor.value = display(chosen);
  }

  /** Gives a geometry the cloud's points as vertices. */
  addTo(geometry: BufferGeometry): void {
    geometry.setAttribute("position", this.#position);
    geometry.setAttribute("spread", this.#spread);
    if (this.#color) geometry.setAttribute("color", this.#color);
    if (this.#chosen) geometry.setAttribute("chosen", this.#chosen);
    // Otherwise three.js computes it from all points, once for each geometry.
    geometry.boundingSphere = this.#bounds;
    this.#geometries.push(geometry);
  }

  /** Sets the points that are selected. */
  setChosen(indices: Uint32Array): void {
    if (!this.#chosen) {
      if (indices.length === 0) return;
      this.#chosen = new BufferAttribute(new Uint8Array(this.#local.length / 3), 1, true).setUsage(DynamicDrawUsage);
      for (const geometry of this.#geometries) geometry.setAttribute("chosen", this.#chosen);
    }
    const marks = this.#chosen.array as Uint8Array;
    marks.fill(0);
    for (const index of indices) marks[index] = 255;
    this.#chosen.needsUpdate = true;
  }

  setUp(up: Up): void {
    this.uniforms.up.value.set(...upVector(up));
    this.uniforms.heights.value.copy(rampHeights(this.#local, this.uniforms.up.value));
  }

  /** Takes three bytes for each point. `null`: the file's own colors, or two tones if it has none. */
  setTints(tints: Uint8Array | null): void {
    const colors = tints ?? this.#ownColors;
    this.uniforms.colored.value = colors !== null;
    if (!colors) return;
    if (this.#color) {
      (this.#color.array as Uint8Array).set(colors);
      this.#color.needsUpdate = true;
      return;
    }
    // This is a copy, because the file's own colors must not change.
    this.#color = new BufferAttribute(colors.slice(), 3, true).setUsage(DynamicDrawUsage);
    for (const geometry of this.#geometries) geometry.setAttribute("color", this.#color);
  }
}

/** The display color for the shaders. The colors of three.js are linear. */
export function display(color: string): Color {
  return new Color(color).convertLinearToSRGB();
}

/** The heights of the first and the last color. A few stray points below and above do not count. */
function rampHeights(local: Float32Array, { x, y, z }: Vector3): Vector2 {
  const [low, high] = spreadOf(
    local.length / 3,
    (i) => local[3 * i]! * x + local[3 * i + 1]! * y + local[3 * i + 2]! * z,
  );
  return high > low ? new Vector2(low, high) : new Vector2(low - 1, low + 1);
}
