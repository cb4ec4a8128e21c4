import { createRequire } from "node:module";
import type { Plugin } from "vite";

/** The renderer puts these pieces into every program. Those for tone mapping are not among them: nothing is mapped. */
const USED = ["colorspace_pars_fragment"];
const PIECE = /three\/src\/renderers\/shaders\/Shader(Chunk|Lib)\/(\w+)\.glsl\.js$/;

/**
 * Parts of the renderer that the page never uses, since its materials are all its own, and its scenes have no lights,
 * no shadows and no environment. Each gets a part of the same form that does nothing.
 */
const UNUSED: Record<string, string> = {
  "renderers/webxr/WebXRManager": `export class WebXRManager {
    enabled = false;
    isPresenting = false;
    addEventListener() {}
    removeEventListener() {}
    setAnimationLoop() {}
    dispose() {}
  }`,
  "renderers/webgl/WebGLEnvironments":
    "export const WebGLEnvironments = function () { return { get: () => null, dispose() {} }; };",
  "renderers/webgl/WebGLShadowMap": "export const WebGLShadowMap = function () { this.render = () => {}; };",
  "renderers/webgl/WebGLMorphtargets": "export const WebGLMorphtargets = function () { return { update() {} }; };",
  "renderers/webgl/WebGLUniformsGroups": "export const WebGLUniformsGroups = function () { return { dispose() {} }; };",
  "renderers/webgl/WebGLMaterials":
    "export const WebGLMaterials = function () { return { refreshMaterialUniforms(uniforms, material) { material.uniformsNeedUpdate = false; } }; };",
  "renderers/webgl/WebGLLights": `const none = [];
    export const WebGLLights = function () {
      const state = { version: 0, numSpotLightShadowsWithMaps: 0, numLightProbes: 0 };
      for (const kind of ["sun", "directional", "point", "spot"]) state[kind] = state[kind + "ShadowMap"] = none;
      for (const kind of ["spotLightMap", "rectArea", "hemi"]) state[kind] = none;
      return { setup() {}, setupView() {}, state };
    };`,
  "renderers/webgl/WebGLBackground": `export const WebGLBackground = function () {
    return { render() {}, addToRenderList() {}, getClearColor() {}, setClearColor() {}, getClearAlpha() {}, dispose() {} };
  };`,
  "renderers/webgl/WebGLOutput": "export const WebGLOutput = null;",
  "renderers/webgl/WebGLUtils": `import { DepthFormat, RGBAFormat, UnsignedByteType, UnsignedIntType } from "../../constants.js";
    const known = { [RGBAFormat]: 6408, [DepthFormat]: 6402, [UnsignedByteType]: 5121, [UnsignedIntType]: 5125 };
    export const WebGLUtils = function () { return { convert: (constant) => known[constant] ?? null }; };`,
  "renderers/shaders/ShaderLib": "export const ShaderLib = {};",
  "renderers/shaders/DFGLUTData": "export const getDFGLUT = () => null;",
};

/**
 * Leaves out the shaders of three.js's own materials, and the parts of its renderer that only they need. This makes the
 * first download smaller by a quarter of three.js. A file of three.js's single module cannot be left out, so its
 * sources are bundled instead.
 */
export function ownShadersOnly(): Plugin {
  const require = createRequire(import.meta.url);
  return {
    name: "own-shaders-only",
    apply: "build",
    enforce: "pre",
    resolveId: (id) => (id === "three" ? require.resolve("three/src/Three.js") : null),
    load: (id) => {
      const unused = UNUSED[/three\/src\/(.+)\.js$/.exec(id)?.[1] ?? ""];
      if (unused !== undefined) return unused;
      const [, kind, name] = PIECE.exec(id) ?? [];
      if (kind === "Lib") return 'export const vertex = "", fragment = "";';
      return kind === "Chunk" && !USED.includes(name!) ? 'export default "";' : null;
    },
  };
}
