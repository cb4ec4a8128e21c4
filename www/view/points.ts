import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Points,
  ShaderMaterial,
  Sphere,
  Vector2,
  Vector3,
} from "three";
import { type Cloud, type Up, upVector } from "../cloud/cloud.ts";
import { LOCAL_SPACING, spreadOf } from "../cloud/prepare.ts";
import { display, type Theme } from "./theme.ts";

/** The share of a selected point's own color that is covered. */
const CHOSEN_COVERAGE = 0.65;

/** The text before the `main` of a vertex shader: the color of a vertex. */
const TINT_SHADER = /* glsl */ `
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
  /* The part of the picture that is shown, from left to right in clip space, and the width of a pixel there. */
  uniform vec3 part;
  varying vec3 tint;
  varying float size;

  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    size = clamp(width * ${LOCAL_SPACING} * pixels / gl_Position.w, least, max(least, most));
    gl_PointSize = size;
    // Far beyond the dividing line, nobody sees the point, nor its shade.
    float x = gl_Position.x / gl_Position.w;
    float near = (size + 16.0) * part.z;
    if (gl_Position.w > 0.0 && (x < part.x - near || x > part.y + near)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    // A point that is left out.
    if (spread == 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
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
 * The cloud in two draws of the same points. `solid` draws the visible ones: a filter of the package leaves out the
 * others, and draws them with the material `ghost` if they are wanted. `all` draws all points, as any viewer shows them.
 */
export class CloudPoints {
  readonly cloud: Cloud;
  readonly solid: Draw;
  readonly ghost: ShaderMaterial;
  readonly all: Draw;
  /** Shared by all materials of the cloud. */
  readonly #shared = {
    up: { value: new Vector3(0, 1, 0) },
    heights: { value: new Vector2(-1, 1) },
    // The colors are not converted, because the shading pass and the screen both take display colors.
    low: { value: new Color() },
    high: { value: new Color() },
    chosenColor: { value: new Color() },
    colored: { value: false },
  };
  readonly #draws: Draw[];
  #theme: Theme;
  #ghostly = false;
  #color: BufferAttribute | null = null;
  #chosen: BufferAttribute | null = null;
  readonly #spread: BufferAttribute;

  constructor(cloud: Cloud, theme: Theme) {
    this.cloud = cloud;
    this.#theme = theme;
    const position = new BufferAttribute(cloud.local, 3);
    const spread = (this.#spread = new BufferAttribute(cloud.spacing.local, 1, true));
    // Otherwise three.js computes it from all points, once for each geometry.
    const bounds = new Sphere(new Vector3(), cloud.radius);
    const draw = (most: number, ...materials: [material: ShaderMaterial, least: number][]): Draw => {
      const geometry = new BufferGeometry().setAttribute("position", position).setAttribute("spread", spread);
      geometry.boundingSphere = bounds;
      const points = new Points(geometry, materials[0]![0]);
      points.frustumCulled = false;
      points.onBeforeRender = (renderer, scene, camera) => {
        const { x: width, y: height } = renderer.getDrawingBufferSize(new Vector2());
        const ratio = renderer.getPixelRatio();
        const [from, to] = scene.userData["part"] as [number, number];
        const pixels = (camera.projectionMatrix.elements[5] * height) / 2;
        for (const [{ uniforms }, share] of materials) {
          const least = share * leastPixels(cloud.count, width / ratio) * ratio;
          const part = new Vector3(2 * from - 1, 2 * to - 1, 2 / width);
          for (const [name, value] of Object.entries({ part, pixels, least, most: most * ratio })) {
            uniforms[name]!.value = value;
          }
        }
      };
      return points;
    };
    this.ghost = this.#material(COVERAGE);
    // Visible points look solid beside all points, whose far side shows between them.
    this.solid = draw(MOST_PIXELS, [this.#material(0), 1.2], [this.ghost, 1 / 1.5]);
    this.all = draw(MOST_SMALL, [this.#material(0), 1 / 1.2]);
    this.#draws = [this.solid, this.all];
    this.setTints(null);
    this.setTheme(theme);
  }

  #material(coverage: number): ShaderMaterial {
    const uniforms = { width: 0, pixels: 1, least: 1, most: 1, cover: new Color(), coverage, part: new Vector3() };
    const own = Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, { value }]));
    return new ShaderMaterial({ vertexShader, fragmentShader, uniforms: { ...this.#shared, ...own } });
  }

  /** Sets the points that are selected. */
  setChosen(indices: Uint32Array): void {
    if (!this.#chosen) {
      if (indices.length === 0) return;
      this.#chosen = new BufferAttribute(new Uint8Array(this.cloud.count), 1, true).setUsage(DynamicDrawUsage);
      for (const { geometry } of this.#draws) geometry.setAttribute("chosen", this.#chosen);
    }
    const marks = this.#chosen.array as Uint8Array;
    marks.fill(0);
    for (const index of indices) marks[index] = 255;
    this.#chosen.needsUpdate = true;
  }

  /** Draws only the points of a mask; `null`: all. */
  setPart(mask: Uint8Array | null): void {
    const { local } = this.cloud.spacing;
    if (!mask && this.#spread.array === local) return;
    this.#spread.array = mask ? local.map((byte, i) => (mask[i] ? byte : 0)) : local;
    this.#spread.needsUpdate = true;
  }

  setUp(up: Up): void {
    this.#shared.up.value.set(...upVector(up));
    this.#shared.heights.value.copy(rampHeights(this.cloud.local, this.#shared.up.value));
  }

  /** Takes three bytes for each point. `null`: the file's own colors, or two tones if it has none. */
  setTints(tints: Uint8Array | null): void {
    const colors = tints ?? this.cloud.colors;
    this.#shared.colored.value = colors !== null;
    if (!colors) return;
    if (this.#color) {
      (this.#color.array as Uint8Array).set(colors);
      this.#color.needsUpdate = true;
      return;
    }
    // This is a copy, because the file's own colors must not change.
    this.#color = new BufferAttribute(colors.slice(), 3, true).setUsage(DynamicDrawUsage);
    for (const { geometry } of this.#draws) geometry.setAttribute("color", this.#color);
  }

  /** How hidden points look, if the filter draws them. */
  setGhostly(ghostly: boolean): void {
    this.#ghostly = ghostly;
    this.setTheme(this.#theme);
  }

  setTheme(theme: Theme): void {
    this.#theme = theme;
    for (const [name, color] of [
      ["low", theme.low],
      ["high", theme.high],
      ["chosenColor", theme.chosen],
    ] as const) {
      this.#shared[name].value = display(color);
    }
    this.ghost.uniforms["cover"]!.value = display(this.#ghostly ? theme.hiddenDimmed : theme.hidden);
  }

  /**
   * `size`: 1 for points that touch. `through`: the visible points are small, so that the hidden ones behind them show.
   * Returns the width of a typical point in the cloud's units.
   */
  setPointSize(size: number, through: boolean): number {
    const set = ({ uniforms }: ShaderMaterial, spacings: number): number =>
      (uniforms["width"]!.value = spacings * this.cloud.spacing.typical);
    set(this.ghost, HIDDEN_WIDTH);
    set(this.all.material, SMALL);
    return set(this.solid.material, (through ? SMALL : COVERING) * size);
  }

  dispose(): void {
    for (const { geometry, material } of this.#draws) {
      geometry.dispose();
      material.dispose();
    }
    this.ghost.dispose();
  }
}

/**
 * The least width of a point in pixels. If there are few points, it is larger, so that they can be found. In a narrow
 * picture it is smaller, so that points do not cover one another.
 */
function leastPixels(count: number, width: number): number {
  return count < 100 ? 6 : count < 1000 ? 3 : Math.min(1.5, Math.max(1, width / 700));
}
/** The heights of the first and the last color. A few stray points below and above do not count. */
function rampHeights(local: Float32Array, { x, y, z }: Vector3): Vector2 {
  const [low, high] = spreadOf(
    local.length / 3,
    (i) => local[3 * i]! * x + local[3 * i + 1]! * y + local[3 * i + 2]! * z,
  );
  return high > low ? new Vector2(low, high) : new Vector2(low - 1, low + 1);
}
