import type { Plugin } from "vite";

/** Three.js adds these to every shader. The page's own shaders include no others. */
const NEEDED = ["colorspace_pars_fragment", "tonemapping_pars_fragment"];
/** A shader: a text with a name, at the top of the file. */
const SHADER = /^(var|const) ([\w$]+) = ("(?:[^"\\]|\\.)*"|`[^`]*`);$/gm;
const LEFT_OUT =
  "This build of three.js draws with the page's own shaders, without lights, headsets, environments and shapes that change.";

/** Parts of the renderer that it always makes, or never for this page, and what stands in for them. */
const PARTS: Record<string, string> = {
  UniformsLib: "const UniformsLib = {};",
  ShaderLib: "const ShaderLib = {};",
  WebXRManager: `class WebXRManager extends EventDispatcher {
    enabled = false; isPresenting = false;
    getEnvironmentBlendMode() { return "opaque"; } setAnimationLoop() {} dispose() {}
  }`,
  WebGLShadowMap: `function WebGLShadowMap() { this.enabled = false; this.render = () => {}; }`,
  // The picture is cleared to black: the page draws its own background.
  WebGLBackground: `function WebGLBackground(renderer, environments, state) {
    const color = new Color(0);
    return {
      getClearColor: () => color, getClearAlpha: () => 1,
      render() { state.buffers.color.setClear(0, 0, 0, 1); }, addToRenderList() {}, dispose() {},
    };
  }`,
  WebGLLights: `function WebGLLights() {
    const state = { version: 0, hash: {}, numSpotLightShadowsWithMaps: 0, numLightProbes: 0 };
    for (const kind of ["sun", "directional", "spot", "point"])
      for (const part of ["", "Shadow", "ShadowMap", "ShadowMatrix", "ShadowCascade", "LightMap", "LightMatrix"])
        state[kind + part] = [];
    for (const kind of ["ambient", "probe", "rectArea", "hemi"]) state[kind] = [];
    return { state, setup() {}, setupView() {} };
  }`,
  WebGLMaterials: `function WebGLMaterials() {
    return { refreshMaterialUniforms(uniforms, material) { material.uniformsNeedUpdate = false; } };
  }`,
  WebGLEnvironments: `function WebGLEnvironments() { return { get: (texture) => texture, dispose() {} }; }`,
  WebGLUniformsGroups: `function WebGLUniformsGroups() { return { dispose() {} }; }`,
  WebGLMorphtargets: `function WebGLMorphtargets() { return {}; }`,
  WebGLOutput: `function WebGLOutput() { throw new Error(${JSON.stringify(LEFT_OUT)}); }`,
  PMREMGenerator: `class PMREMGenerator { constructor() { throw new Error(${JSON.stringify(LEFT_OUT)}); } }`,
  getDFGLUT: `function getDFGLUT() { throw new Error(${JSON.stringify(LEFT_OUT)}); }`,
};

/** Leaves out what the page does not need of three.js: a third of the renderer. */
export function three(): Plugin {
  return {
    name: "three",
    apply: "build",
    enforce: "pre",
    transform(code, id) {
      if (!/\/three\/build\/three\.module\.js$/.test(id)) return undefined;
      let shaders = 0;
      let less = code.replace(SHADER, (whole, keyword: string, name: string, text: string) => {
        if (NEEDED.includes(name) || !/gl_|uniform|#|vec/.test(text)) return whole;
        shaders++;
        return `${keyword} ${name} = ${JSON.stringify(`#error ${LEFT_OUT}`)};`;
      });
      if (shaders < 90) this.error("The shaders of three.js were not found.");
      less = less.replace(/^ShaderLib\.\w+ = {[^]*?^};$/gm, "");
      for (const [name, instead] of Object.entries(PARTS)) {
        const before = less;
        less = less.replace(new RegExp(`^(class|function|const) ${name}\\b[^]*?^};?$`, "m"), instead);
        if (less === before) this.error(`Three.js has no ${name}.`);
      }
      return { code: less, map: null };
    },
  };
}
