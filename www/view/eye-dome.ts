import {
  Color,
  DepthTexture,
  GLSL3,
  NearestFilter,
  type Object3D,
  type PerspectiveCamera,
  type Scene,
  ShaderMaterial,
  Vector2,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import { FullScreenQuad } from "three/addons/postprocessing/Pass.js";

/*
 * Eye-dome lighting (C. Boucheny, 2009). A scan has no normals for shading. So a pixel is darker the farther its
 * neighbors are in front of it. Edges, folds and slopes become visible. Points that show through from behind become
 * visible, too.
 */

const STRENGTH = 150;
/** The shade of an edge, however far its other side lies behind: darker ones would be black rims. */
const DARKEST = 0.55;
/** Points wider than this many device pixels are shaded more softly, since each would get its own dark rim. */
const SOFT_FROM = 2;
/** Gaps of less than this many widths of a point on either side are closed: points are missed beside silhouettes. */
const GAP = 1.8;
/** The distance of the neighbors in device pixels. For wide points it grows by this share of their extra width. */
const REACH = 1.6;
const WIDE = 0.5;

const vertexShader = /* glsl */ `
  void main() {
    gl_Position = vec4(position, 1.0);
  }
`;

const fragmentShader = /* glsl */ `
  uniform sampler2D colors, allColors;
  uniform highp sampler2D depths, allDepths;
  uniform vec2 planes;
  uniform vec3 background;
  uniform float reach, softness;
  /* How opaque all points are where the scene is empty, and up to which pixel from the left they are drawn alone. */
  uniform float behind, alone;
  out vec4 result;

  const vec2 AROUND[8] = vec2[8](
    vec2(1.0, 0.0), vec2(0.7, 0.7), vec2(0.0, 1.0), vec2(-0.7, 0.7),
    vec2(-1.0, 0.0), vec2(-0.7, -0.7), vec2(0.0, -1.0), vec2(0.7, -0.7));

  /* One divided by the distance from the eye, in a unit of its own. */
  float nearness(float depth) {
    return planes.y - depth * (planes.y - planes.x);
  }

  vec3 shaded(sampler2D colors, highp sampler2D depths, ivec2 pixel, float depth) {
    ivec2 last = textureSize(depths, 0) - 1;
    float own = nearness(depth);
    float soft = min(1.0, planes.x * planes.y / (own * softness));
    float step = reach * max(1.0, ${WIDE.toFixed(1)} / soft);
    // Equal ratios of distance are equal steps. The product of eight ratios takes one logarithm instead of eight.
    float ratios = 1.0;
    for (int i = 0; i < 8; i++) {
      ivec2 there = clamp(ivec2(round(vec2(pixel) + step * AROUND[i])), ivec2(0), last);
      float other = texelFetch(depths, there, 0).r;
      ratios *= other < 1.0 ? max(1.0, nearness(other) / own) : 1.0;
    }
    float shade = exp(-${STRENGTH.toFixed(1)} * soft * log2(ratios) / 8.0);
    return texelFetch(colors, pixel, 0).rgb * mix(${DARKEST}, 1.0, shade);
  }

  /*
   * A gap with a surface on most sides of it is closed if it is of few pixels, or as small as the points around it: the
   * pixel beside it that stands for it.
   */
  ivec2 closed(ivec2 pixel) {
    ivec2 last = textureSize(depths, 0) - 1;
    for (float ring = 16.0; ring > 1.0; ring /= 2.0) {
      ivec2 found = pixel;
      float nearest = 1.0;
      int sides = 0;
      for (int i = 0; i < 8; i++) {
        ivec2 there = clamp(ivec2(round(vec2(pixel) + ring * AROUND[i])), ivec2(0), last);
        float depth = texelFetch(depths, there, 0).r;
        if (depth < 1.0) sides++;
        if (depth < nearest) {
          nearest = depth;
          found = there;
        }
      }
      float width = ${SOFT_FROM.toFixed(1)} * nearness(nearest) * softness / (planes.x * planes.y);
      if (sides > 5 && (ring == 2.0 || ring < ${GAP.toFixed(1)} * width)) return found;
      // Most of the background is far from any surface.
      if (sides == 0 && ring == 16.0) return pixel;
    }
    return pixel;
  }

  void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool isAlone = gl_FragCoord.x < alone;
    float depth = isAlone ? 1.0 : texelFetch(depths, pixel, 0).r;
    if (depth == 1.0 && !isAlone) {
      pixel = closed(pixel);
      depth = texelFetch(depths, pixel, 0).r;
    }
    if (depth < 1.0) {
      gl_FragDepth = depth;
      result = vec4(shaded(colors, depths, pixel, depth), 1.0);
      return;
    }
    depth = isAlone || behind > 0.0 ? texelFetch(allDepths, pixel, 0).r : 1.0;
    gl_FragDepth = depth;
    vec3 color = background;
    if (depth < 1.0) {
      // The shade of small points would make the far side darker, and hide it.
      color = mix(color, texelFetch(allColors, pixel, 0).rgb, isAlone ? 1.0 : behind);
    }
    result = vec4(color, 1.0);
  }
`;

/** All points as any viewer shows them, behind the points of an answer. */
export interface AllPoints {
  scene: Scene;
  /** From 0 to 1, where the answer leaves the picture empty. */
  opacity: number;
  /** The share of the picture's width, from its left, in which the answer is not drawn. */
  alone: number;
}

export class EyeDome {
  /** The width of a point in the scene's units. */
  pointWidth = 1;
  readonly #target = newTarget();
  /** The picture of all points, if it is needed. */
  #allTarget: WebGLRenderTarget | null = null;
  readonly #material: ShaderMaterial;
  readonly #screen: FullScreenQuad;
  readonly #size = new Vector2();
  readonly #planes = new Vector2();

  constructor() {
    this.#material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      glslVersion: GLSL3,
      uniforms: {
        colors: { value: this.#target.texture },
        depths: { value: this.#target.depthTexture },
        allColors: { value: null },
        allDepths: { value: null },
        behind: { value: 0 },
        alone: { value: 0 },
        planes: { value: this.#planes },
        background: { value: new Color() },
        reach: { value: REACH },
        softness: { value: 1 },
      },
    });
    this.#screen = new FullScreenQuad(this.#material);
  }

  /** Sets the background, in display colors. */
  setBackground(color: Color): void {
    this.#material.uniforms["background"]!.value = color;
  }

  /**
   * Draws the shaded scene onto the screen, with its depths, so that more can be drawn among the points. Where the scene
   * is empty, and in the part of the picture that is theirs alone, `all` shows.
   */
  render(renderer: WebGLRenderer, scene: Scene, all: AllPoints, camera: PerspectiveCamera): void {
    const { uniforms } = this.#material;
    uniforms["behind"]!.value = all.opacity;
    uniforms["alone"]!.value = all.alone * renderer.getDrawingBufferSize(this.#size).x;
    scene.userData["part"] = [all.alone, 1];
    all.scene.userData["part"] = [0, all.opacity > 0 ? 1 : all.alone];
    if (all.opacity > 0 || all.alone > 0) {
      this.#allTarget ??= newTarget();
      uniforms["allColors"]!.value = this.#allTarget.texture;
      uniforms["allDepths"]!.value = this.#allTarget.depthTexture;
      this.#drawInto(this.#allTarget, renderer, all.scene, camera);
    }
    if (all.alone < 1) this.#drawInto(this.#target, renderer, scene, camera);
    this.#shade(renderer, camera);
    renderer.clear();
    this.#screen.render(renderer);
  }

  compile(renderer: WebGLRenderer, points: Object3D, camera: PerspectiveCamera): void {
    renderer.setRenderTarget(this.#target);
    renderer.compile(points, camera);
    renderer.setRenderTarget(null);
  }

  dispose(): void {
    this.#screen.dispose();
    this.#material.dispose();
    for (const target of [this.#target, this.#allTarget]) {
      target?.depthTexture?.dispose();
      target?.dispose();
    }
  }

  #shade(renderer: WebGLRenderer, camera: PerspectiveCamera): void {
    this.#planes.set(camera.near, camera.far);
    this.#material.uniforms["reach"]!.value = REACH * renderer.getPixelRatio();
    // At this distance a point is as wide as SOFT_FROM pixels. Nearer points are wider in proportion.
    const pixels = (camera.projectionMatrix.elements[5] * this.#size.y) / 2;
    this.#material.uniforms["softness"]!.value = (this.pointWidth * pixels) / SOFT_FROM;
  }

  #drawInto(target: WebGLRenderTarget, renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera): void {
    const { x: width, y: height } = renderer.getDrawingBufferSize(this.#size);
    if (target.width !== width || target.height !== height) target.setSize(width, height);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
  }
}

function newTarget(): WebGLRenderTarget {
  return new WebGLRenderTarget(1, 1, {
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    depthTexture: new DepthTexture(1, 1),
  });
}
