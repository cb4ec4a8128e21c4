// What the filter uses of Potree's viewer, without a graphics card: it notes what the card would be told, and which points
// the vertex shader would draw.
import * as THREE from "three";

/** The vertex shader's uniforms of one node, and the texture of the answer. */
interface Told {
  numbers: Map<string, number>;
  answer: Uint8Array | undefined;
}

/** A card that has two textures: the map's and the answer's. */
function cardOf(told: Told) {
  const constants = ["TEXTURE0", "TEXTURE_2D", "FLOAT", "UNSIGNED_BYTE", "RED", "R8", "R32F", "MAX_TEXTURE_SIZE"];
  const names: Record<string, unknown> = Object.fromEntries(constants.map((name) => [name, name]));
  const nothing = () => undefined;
  const methods = ["activeTexture", "bindTexture", "pixelStorei", "texParameteri", "deleteTexture", "uniform1i"];
  return {
    ...names,
    ...Object.fromEntries([...methods, "uniform3f", "uniform2f"].map((name) => [name, nothing])),
    texStorage2D: nothing,
    createTexture: () => ({}),
    getParameter: (name: string) => (name === "MAX_TEXTURE_SIZE" ? 4096 : 16),
    uniform1f: (name: string, value: number) => told.numbers.set(name, value),
    texImage2D: (...args: unknown[]) => {
      const data = args.at(-1);
      if (data instanceof Uint8Array) told.answer = data;
    },
  };
}

/** The cloud in so many nodes, each with a place of its own, in a viewer. */
export function viewerOf(positions: Float32Array, count: number) {
  const told: Told = { numbers: new Map(), answer: undefined };
  const size = Math.ceil(positions.length / 3 / count);
  const nodes = Array.from({ length: count }, (_, k) => {
    const part = positions.slice(3 * size * k, 3 * size * (k + 1));
    const geometry = new THREE.BufferGeometry();
    // A power of two, so that nothing is rounded.
    geometry.setAttribute(
      "position",
      new THREE.BufferAttribute(
        Float64Array.from(part, (x) => x - 64 * k),
        3,
      ),
    );
    const sceneNode = new THREE.Points(geometry);
    sceneNode.position.setScalar(64 * k);
    sceneNode.updateMatrixWorld();
    return { sceneNode, geometryNode: { geometry } };
  });
  type Node = (typeof nodes)[number];
  const names = ["hprMode", "hprFirst", "hprDepths", "hprAnswer", "hprViewpoint", "hprRow", "hprSize"];
  let picture: number[] = [];
  const pRenderer = {
    gl: cardOf(told),
    renderOctree(octree: { visibleNodes: Node[] }, shown: Node[], camera: THREE.Camera, target: unknown) {
      const isPatched = material.vertexShader.includes("hprMode");
      const uniformLocations = isPatched ? Object.fromEntries(names.map((name) => [name, name])) : {};
      const shader = { uniformLocations, setUniform1f: () => undefined };
      told.numbers.clear();
      this.renderNodes(octree, shown, null, camera, target, shader, {});
    },
    renderNodes(
      ...args: [unknown, Node[], unknown, unknown, unknown, { setUniform1f(name: string, i: number): void }, unknown]
    ) {
      const [, shown, , , , shader] = args;
      shown.forEach(({ geometryNode }, i) => {
        shader.setUniform1f("uPCIndex", i);
        const [mode = 0, first = 0] = [told.numbers.get("hprMode"), told.numbers.get("hprFirst")];
        for (let k = 0; k < geometryNode.geometry.attributes["position"]!.count; k++) {
          if (mode !== 2 || told.answer![first + k]! > 0) picture.push(size * i + k);
        }
      });
    },
  };
  const material = { vertexShader: "void main() {}" };
  const octree = { visible: true, material, visibleNodes: nodes };
  const listeners: (() => void)[] = [];
  const viewer = {
    camera: new THREE.PerspectiveCamera() as THREE.Camera,
    scene: { pointclouds: [octree], getActiveCamera: () => viewer.camera },
    pRenderer,
    addEventListener: (_: string, listener: () => void) => void listeners.push(listener),
    removeEventListener: (_: string, listener: () => void) => void listeners.splice(listeners.indexOf(listener), 1),
    frame() {
      for (const listener of listeners) listener();
    },
    /** The points in the picture, as the user's own numbers. */
    drawn() {
      picture = [];
      pRenderer.renderOctree(octree, nodes, viewer.camera, null);
      return picture;
    },
    own: () => JSON.stringify([Object.keys(pRenderer), material, listeners.length]),
  };
  return viewer;
}
