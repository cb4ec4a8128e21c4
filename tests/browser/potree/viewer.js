// What the filter uses of Potree's viewer: nodes with places of their own, a renderer of its own, GLSL ES 1.00.
const VERTEX = `precision highp float;
attribute vec3 position;
attribute vec4 indices;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float uPCIndex;
varying vec3 vColor;
void main() {
  vColor = vec3(indices.xy, 1.0);
  gl_PointSize = 1.0;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = `precision highp float;
varying vec3 vColor;
uniform float uPCIndex;
void main() { gl_FragColor = vec4(vColor, 1.0 - uPCIndex / 255.0); }`;

const product = (a, b) =>
  Array.from({ length: 16 }, (_, i) =>
    [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + (i % 4)] * b[4 * (i >> 2) + k], 0),
  );

class Renderer {
  constructor(gl) {
    this.gl = gl;
    this.programs = new Map();
  }

  renderOctree(octree, nodes, camera, target, params = {}) {
    const { gl } = this;
    const { vertexShader } = params.material ?? octree.material;
    let shader = this.programs.get(vertexShader);
    if (shader === undefined) {
      shader = this.compile(vertexShader);
      this.programs.set(vertexShader, shader);
    }
    gl.useProgram(shader.program);
    gl.uniformMatrix4fv(shader.uniformLocations.projectionMatrix, false, camera.projectionMatrix.elements);
    this.renderNodes(octree, nodes, null, camera, target, shader, params);
  }

  renderNodes(octree, nodes, data, camera, target, shader) {
    const { gl } = this;
    nodes.forEach((node, i) => {
      const { attributes } = node.geometryNode.geometry;
      const place = product(camera.view, node.sceneNode.matrixWorld.elements);
      gl.uniformMatrix4fv(shader.uniformLocations.modelViewMatrix, false, place);
      shader.setUniform1f("uPCIndex", i);
      for (const [name, size, type] of [
        ["position", 3, gl.FLOAT],
        ["indices", 4, gl.UNSIGNED_BYTE],
      ]) {
        attributes[name].buffer ??= gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, attributes[name].buffer);
        gl.bufferData(gl.ARRAY_BUFFER, attributes[name].array, gl.STATIC_DRAW);
        const at = gl.getAttribLocation(shader.program, name);
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, size, type, true, 0, 0);
      }
      gl.drawArrays(gl.POINTS, 0, attributes.position.count);
    });
  }

  compile(vertexShader) {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [type, text] of [
      [gl.VERTEX_SHADER, vertexShader],
      [gl.FRAGMENT_SHADER, FRAGMENT],
    ]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    const uniformLocations = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(program, i);
      uniformLocations[name] = gl.getUniformLocation(program, name);
    }
    const setUniform1f = (name, value) => gl.uniform1f(uniformLocations[name] ?? null, value);
    return { program, uniformLocations, setUniform1f };
  }
}

/** 30,000 points of a bumpy ball far from the origin, in five nodes. The fifth comes later. */
globalThis.makeViewer = (canvas = document.querySelector("canvas").cloneNode()) => {
  const gl = canvas.getContext("webgl", { antialias: false, preserveDrawingBuffer: true });
  const [PER_NODE, HOME] = [6000, [500_000, 4_000_000, 100]];
  const material = { vertexShader: VERTEX };
  const nodes = [0, 1, 2, 3, 4].map((k) => {
    const array = new Float32Array(3 * PER_NODE);
    const numbers = new Uint8Array(4 * PER_NODE);
    for (let i = 0; i < PER_NODE; i++) {
      const id = 5 * i + k;
      const up = 1 - (2 * (id + 0.5)) / (5 * PER_NODE);
      const turn = id * 2.399963;
      const radius = (2 + 0.2 * Math.sin(7 * turn)) * Math.sqrt(1 - up * up);
      array.set([radius * Math.cos(turn) - k, 2 * up + k, radius * Math.sin(turn)], 3 * i);
      numbers.set([i & 255, i >> 8], 4 * i);
    }
    const attributes = {
      position: {
        array,
        itemSize: 3,
        count: PER_NODE,
        version: 0,
        getX: (i) => array[3 * i],
        getY: (i) => array[3 * i + 1],
        getZ: (i) => array[3 * i + 2],
      },
      indices: { array: numbers, count: PER_NODE },
    };
    const elements = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, HOME[0] + k, HOME[1] - k, HOME[2], 1];
    return { geometryNode: { geometry: { attributes } }, sceneNode: { matrixWorld: { elements } } };
  });
  const camera = {
    isCamera: true,
    isPerspectiveCamera: true,
    projectionMatrix: { elements: [2.7, 0, 0, 0, 0, 2.7, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0] },
    matrixWorld: { elements: [] },
    updateWorldMatrix() {},
  };
  const octree = { visible: true, material, visibleNodes: nodes.slice(0, 4) };
  const listeners = [];
  const viewer = {
    scene: { pointclouds: [octree], getActiveCamera: () => camera },
    pRenderer: new Renderer(gl),
    addEventListener: (type, listener) => listeners.push(listener),
    removeEventListener: (type, listener) => listeners.splice(listeners.indexOf(listener), 1),
  };
  gl.enable(gl.DEPTH_TEST);
  const draw = () => {
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    viewer.pRenderer.renderOctree(octree, octree.visibleNodes, camera, null);
    const pixels = new Uint8Array(4 * 300 * 300);
    gl.readPixels(0, 0, 300, 300, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels;
  };
  const idAt = (pixels, at) =>
    pixels[at + 2] === 255 ? (255 - pixels[at + 3]) * PER_NODE + pixels[at] + 256 * pixels[at + 1] : undefined;
  return Object.assign(viewer, {
    positions: Float64Array.from(
      nodes.slice(0, 4).flatMap(({ geometryNode, sceneNode }) => {
        const { array } = geometryNode.geometry.attributes.position;
        return Array.from(array, (x, i) => x + sceneNode.matrixWorld.elements[12 + (i % 3)]);
      }),
    ),
    frame(degrees) {
      const [s, c] = [Math.sin((degrees * Math.PI) / 180), Math.cos((degrees * Math.PI) / 180)];
      camera.matrixWorld.elements = [c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, HOME[0] + 9 * s, HOME[1], HOME[2] + 9 * c, 1];
      const [x, y, z] = camera.matrixWorld.elements.slice(12);
      camera.view = [c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, 0, -(c * x - s * z), -y, -(s * x + c * z), 1];
      for (const listener of listeners) listener();
      const pixels = draw();
      const ids = [];
      for (let at = 0; at < pixels.length; at += 4) if (pixels[at + 2] === 255) ids.push(idAt(pixels, at));
      return ids;
    },
    pick() {
      // Potree's material for picking writes the numbers of points.
      material.vertexShader = `#define color_type_indices\n${VERTEX}`;
      const pixels = draw();
      material.vertexShader = VERTEX;
      let best;
      for (let at = 0; at < pixels.length; at += 4) {
        const [x, y] = [((at / 4) % 300) - 150, Math.floor(at / 1200) - 150];
        if (pixels[at + 2] === 255 && (best === undefined || x * x + y * y < best.far)) {
          best = { far: x * x + y * y, id: idAt(pixels, at) };
        }
      }
      return best?.id;
    },
    addNode() {
      octree.visibleNodes = nodes;
    },
    own: () => JSON.stringify([Object.keys(viewer.pRenderer), material]),
  });
};
globalThis.frame = () => new Promise((resolve) => requestAnimationFrame(() => resolve()));
