import { DataTexture, FloatType, type Material, Matrix3, RedFormat, Vector3, Vector4 } from "three";
import {
  code,
  Fn,
  glslFn,
  modelViewProjection,
  positionGeometry,
  select,
  texture,
  uniform,
  vec3,
  vec4,
  wgslFn,
} from "three/tsl";
import type { Node, NodeBuilder } from "three/webgpu";

import { GLSL, WGSL } from "../cloud/visibility-shader.js";
import { override } from "../base/objects.js";
import { MapPatch, patching } from "./map-material.js";

type Patched = Material & { vertexNode?: Node<"vec4"> | null };

/** The test without globals, in the language of either backend. */
const inGLSL = glslFn("bool hprHidden(vec3 p, vec4 m, property t) { return hprTest(p, vec3(0.0), m, t); }", [
  // Only for a parameter of this type does three write the name of the texture.
  code("#define property highp sampler2D\n"),
  code(
    GLSL.replace(/^uniform .*\n/gm, "")
      .replace("hprDepth(int i)", "hprDepth(int i, highp sampler2D hprDepths)")
      .replace(
        "hidden(highp vec3 position)",
        "hprTest(highp vec3 position, highp vec3 hprViewpoint, highp vec4 hprMargins, highp sampler2D hprDepths)",
      )
      .replace(/hprDepth\((?!int i)((?:[^()]|\([^()]*\))*)\)/g, "hprDepth($1, hprDepths)"),
  ),
]);
const inWGSL = wgslFn(
  "fn hprHidden(p: vec3<f32>, m: vec4<f32>, t: texture_2d<f32>) -> bool { return hprTest(p, vec3f(0.0), m, t); }",
  [
    code(
      WGSL.replace("hprDepth(i: i32)", "hprDepth(i: i32, hprDepths: texture_2d<f32>)")
        .replace(
          "hidden(position: vec3f)",
          "hprTest(position: vec3f, hprViewpoint: vec3f, hprMargins: vec4f, hprDepths: texture_2d<f32>)",
        )
        .replace(/hprDepth\((?!i: i32)((?:[^()]|\([^()]*\))*)\)/g, "hprDepth($1, hprDepths)"),
    ),
  ],
);

/**
 * A material of the WebGPU renderer that can leave out hidden points: its `vertexNode` moves them out of the picture. The
 * renderer makes node materials of other materials, and takes this node over.
 */
class MapNodes extends MapPatch {
  readonly isPatched = true;
  readonly #nothing = new DataTexture(new Float32Array(256), 256, 1, RedFormat, FloatType);
  #own: Node<"vec4"> | undefined;

  follow(): void {
    const material: Patched = this.material;
    if (this.#own === undefined || material.vertexNode !== this.#own) {
      this.#own = this.#made(material.vertexNode ?? (modelViewProjection as unknown as Node<"vec4">));
      this.restore = override(material, { vertexNode: this.#own });
      material.needsUpdate = true;
    }
  }

  #made(place: Node<"vec4">): Node<"vec4"> {
    const { hprMode, hprDepths, hprMargins, hprEye, hprTurn } = this.uniforms;
    const depths = texture(this.#nothing);
    // These are read for each object, after its `onBeforeRender` has set them.
    const mode = uniform(0).onObjectUpdate(() => {
      depths.value = hprDepths.value ?? this.#nothing;
      return hprMode.value;
    });
    const margins = uniform(new Vector4()).onObjectUpdate(() => hprMargins.value);
    const eye = uniform(new Vector3()).onObjectUpdate(() => hprEye.value);
    const turn = uniform(new Matrix3()).onObjectUpdate(() => hprTurn.value);
    const test = Fn(([from]: [Node<"vec3">], builder: NodeBuilder) => {
      const { backend } = builder.renderer as unknown as { backend: { isWebGPUBackend?: boolean } };
      const language = backend.isWebGPUBackend === true ? inWGSL : inGLSL;
      return language({ p: from, m: margins, t: depths });
    });
    const isHidden = test(turn.mul(vec3(positionGeometry).sub(eye))) as unknown as Node<"bool">;
    const isLeftOut = mode.greaterThan(0).and(isHidden).or(mode.lessThan(0).and(isHidden.not()));
    return select(isLeftOut, vec4(0, 0, 2, 1), place);
  }
}

/** Makes the nodes of a material leave out hidden points. */
export const patchNodes = patching(MapNodes);
