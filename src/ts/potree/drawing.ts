import type { Camera } from "three";

import { allocating } from "../base/errors.js";
import { override } from "../base/objects.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";
import type { NodesDrawing } from "../nodes/gathered.js";
import { withTest } from "../three/map-shader.js";
import { DIMMED } from "../three/options.js";
import {
  type Octree,
  type OctreeNode,
  type PotreeRenderer,
  type PotreeShader,
  type PotreeViewer,
  Tile,
} from "./viewer.js";

/**
 * What `hprMode` is: all points are drawn; the map decides; the last answer does, which has one byte for each point.
 * Potree numbers the points of a node in its attribute `indices`.
 */
const MODE = { all: 0, map: 1, answer: 2 } as const;

/** A point that is left out is moved out of the picture. A dimmed one cannot be picked either. */
const MAIN = `
uniform highp sampler2D hprAnswer;
uniform highp vec2 hprSize;
uniform highp float hprFirst;
bool hprLeftOut() {
  if (hprMode < 1.5) return hprHidden(hprTurn * (position - hprEye));
  highp float i = hprFirst + dot(floor(indices * 255.0 + 0.5), vec4(1.0, 256.0, 65536.0, 16777216.0));
  highp float row = floor((i + 0.5) / hprSize.x);
  return texture2D(hprAnswer, (vec2(i - hprSize.x * row, row) + 0.5) / hprSize).r < 0.5;
}
void main() {
  bool isLeftOut = hprMode > 0.5 && hprLeftOut();
#if defined(color_type_indices) || !defined(hpr_dim)
  if (isLeftOut) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
#endif
  hprMain();
#if defined(hpr_dim)
  if (isLeftOut) vColor *= ${DIMMED};
#endif
}
`;

/** The vertex shaders that were changed, by their text before. Potree compiles each once. */
const changed = new Map<string, string | undefined>();

/** Potree's vertex shader with the test. Undefined if it has no `main`. */
function withAnswer(vertexShader: string, dims: boolean): string | undefined {
  const key = `${dims} ${vertexShader}`;
  if (!changed.has(key)) changed.set(key, withTest(vertexShader, (dims ? "\n#define hpr_dim" : "") + MAIN));
  return changed.get(key);
}

type Context = WebGLRenderingContext | WebGL2RenderingContext;

/** The texture of maps and that of answers, in Potree's own context. It may be one of WebGL 1. */
class Textures {
  readonly #gl: Context;
  readonly #textures = new Map<object, WebGLTexture>();
  /** The units that they are bound to: the last ones, which Potree does not use. */
  readonly units: readonly [map: number, answer: number];
  /** Whether vertex shaders can read maps. */
  readonly readsFloats: boolean;

  constructor(gl: Context) {
    this.#gl = gl;
    const units = gl.getParameter(gl.MAX_COMBINED_TEXTURE_IMAGE_UNITS) as number;
    this.units = [units - 1, units - 2];
    const reads = (gl.getParameter(gl.MAX_VERTEX_TEXTURE_IMAGE_UNITS) as number) > 1;
    this.readsFloats = reads && ("texStorage2D" in gl || gl.getExtension("OES_texture_float") !== null);
  }

  /** Makes room for the bytes of this number of points. */
  bytesFor(points: number): { bytes: Uint8Array; size: readonly [number, number] } {
    const width = Math.min(this.#gl.getParameter(this.#gl.MAX_TEXTURE_SIZE) as number, 4096);
    const height = Math.max(1, Math.ceil(points / width));
    return { bytes: allocating(`${points} bytes`, () => new Uint8Array(width * height)), size: [width, height] };
  }

  /** Copies a map to the card. */
  uploadMap(key: object, { data }: VisibilityMap): void {
    const gl = this.#gl;
    const inner = "R32F" in gl ? gl.R32F : gl.LUMINANCE;
    this.#upload(key, 0, inner, [256, Math.max(1, data.length / 256)], gl.FLOAT, data.length > 0 ? data : null);
  }

  /** Copies an answer to the card. */
  uploadBytes(key: object, bytes: Uint8Array, size: readonly [number, number]): void {
    const gl = this.#gl;
    this.#upload(key, 1, "R8" in gl ? gl.R8 : gl.LUMINANCE, size, gl.UNSIGNED_BYTE, bytes);
  }

  bind(key: object, which: 0 | 1): void {
    const gl = this.#gl;
    gl.activeTexture(gl.TEXTURE0 + this.units[which]);
    gl.bindTexture(gl.TEXTURE_2D, this.#textures.get(key) ?? null);
  }

  drop(key: object): void {
    this.#gl.deleteTexture(this.#textures.get(key) ?? null);
    this.#textures.delete(key);
  }

  dispose(): void {
    for (const key of [...this.#textures.keys()]) this.drop(key);
  }

  #upload(
    key: object,
    which: 0 | 1,
    inner: number,
    [width, height]: readonly [number, number],
    type: number,
    data: Float32Array | Uint8Array | null,
  ): void {
    const gl = this.#gl;
    const isNew = !this.#textures.has(key);
    if (isNew) this.#textures.set(key, gl.createTexture());
    this.bind(key, which);
    gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, inner, width, height, 0, "RED" in gl ? gl.RED : gl.LUMINANCE, type, data);
    if (isNew) {
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    }
    gl.activeTexture(gl.TEXTURE0);
  }
}

/** The points of an answer, one byte for each, and where those of a node begin. */
interface Answer {
  bytes: Uint8Array;
  size: readonly [number, number];
  spans: Map<Tile, { first: number; revision: number }>;
  length: number;
  isSent: boolean;
}

/** What is drawn for a camera. New nodes have no answer yet: the map of the same place shows them. */
interface Shown {
  map: VisibilityMap | undefined;
  answer: Answer | undefined;
  isAnswered: boolean;
}

/**
 * Draws the nodes of Potree's clouds. Its renderer sends all points of a node to the card, so the vertex shader leaves
 * out hidden points, by the map or by the answer. As picking goes through the same renderer, it does not meet them either.
 */
export class PotreeDrawing implements NodesDrawing<Tile> {
  enabled = true;
  dim: boolean;
  version = 0;
  readonly #viewer: PotreeViewer;
  readonly #renderer: PotreeRenderer;
  readonly #textures: Textures;
  readonly #tiles = new Map<OctreeNode, Tile>();
  readonly #shown = new Map<unknown, Shown>();
  readonly #restore: () => void;
  #camera: unknown;
  #frame = 0;

  constructor(viewer: PotreeViewer, dim: boolean) {
    this.#viewer = viewer;
    this.dim = dim;
    this.#renderer = viewer.pRenderer as PotreeRenderer;
    this.#textures = new Textures(this.#renderer.gl);
    this.#restore = this.#hook();
  }

  get isAble(): boolean {
    return this.#textures.readsFloats;
  }

  follow(): void {
    // Potree's renderer has all changes of the points itself.
  }

  takeUp(): void {
    this.#frame += 1;
    for (const octree of this.#viewer.scene.pointclouds as readonly Octree[]) {
      if (octree.visible) this.#takeUpAll(octree.visibleNodes);
    }
    for (const [node, tile] of this.#tiles) {
      if (tile.seen !== this.#frame) {
        this.#tiles.delete(node);
        this.version += 1;
      }
    }
  }

  present(): Tile[] {
    return [...this.#tiles.values()];
  }

  select(camera: unknown): void {
    this.#camera = camera;
  }

  setStale(camera: unknown): void {
    this.#shown.delete(camera);
  }

  map(camera: unknown, map: VisibilityMap): void {
    const shown = this.#of(camera);
    shown.map = map;
    shown.isAnswered = false;
    this.#textures.uploadMap(shown, map);
  }

  begin(camera: unknown, points: number): void {
    const shown = this.#of(camera);
    const { answer } = shown;
    const isRoomy = answer !== undefined && answer.bytes.length >= points;
    const kept = isRoomy ? answer : this.#textures.bytesFor(points);
    shown.answer = { ...kept, spans: new Map(), length: 0, isSent: false };
    shown.isAnswered = true;
  }

  answer(camera: unknown, tile: Tile, own: Uint32Array): number {
    const answer = this.#of(camera).answer!;
    const { length: first, bytes } = answer;
    answer.spans.set(tile, { first, revision: tile.revision });
    answer.length += tile.count;
    bytes.fill(0, first, answer.length);
    for (const index of own) bytes[first + index] = 255;
    return own.length;
  }

  drop(camera: unknown): void {
    const shown = this.#shown.get(camera);
    if (shown !== undefined) {
      this.#textures.drop(shown);
      if (shown.answer !== undefined) this.#textures.drop(shown.answer.bytes);
      this.#shown.delete(camera);
    }
  }

  dispose(): void {
    this.#restore();
    this.#shown.clear();
    this.#textures.dispose();
    this.#tiles.clear();
  }

  #of(camera: unknown): Shown {
    const shown = this.#shown.get(camera) ?? { map: undefined, answer: undefined, isAnswered: false };
    this.#shown.set(camera, shown);
    return shown;
  }

  #takeUpAll(nodes: readonly OctreeNode[]): void {
    for (const node of nodes) {
      const { sceneNode, geometryNode } = node;
      if (sceneNode === null || geometryNode.geometry === undefined) continue;
      let tile = this.#tiles.get(node);
      if (tile === undefined) {
        tile = new Tile(node, sceneNode);
        this.#tiles.set(node, tile);
        this.version += 1;
      } else if (tile.noticeChange()) {
        this.version += 1;
      }
      tile.seen = this.#frame;
    }
  }

  /** Whether a picture is taken by the camera that the answers are for. Shadows and maps have other cameras. */
  #draws(camera: Camera): boolean {
    const isShown = this.enabled && this.#shown.has(this.#camera);
    return isShown && (this.#camera as { camera: Camera }).camera === camera;
  }

  #hook(): () => void {
    const renderer = this.#renderer;
    // oxlint-disable-next-line typescript/unbound-method -- called with the renderer
    const { renderOctree, renderNodes } = renderer;
    const octree: PotreeRenderer["renderOctree"] = (cloud, nodes, camera, target, params = {}) => {
      const material = params.material ?? cloud.material;
      const { vertexShader } = material;
      const changed = this.#draws(camera) ? withAnswer(vertexShader, this.dim) : undefined;
      material.vertexShader = changed ?? vertexShader;
      try {
        renderOctree.call(renderer, cloud, nodes, camera, target, params);
      } finally {
        material.vertexShader = vertexShader;
      }
    };
    const own: PotreeRenderer["renderNodes"] = (cloud, nodes, data, camera, target, shader, params) => {
      const isPatched = this.#draws(camera) && shader.uniformLocations["hprMode"] !== undefined;
      const through = isPatched ? this.#through(shader, nodes) : shader;
      renderNodes.call(renderer, cloud, nodes, data, camera, target, through, params);
    };
    return override(renderer, { renderOctree: octree, renderNodes: own });
  }

  /** The shader, which also gets the numbers of each node when Potree tells it the node's own number. */
  #through(shader: PotreeShader, nodes: readonly OctreeNode[]): PotreeShader {
    const { gl } = this.#renderer;
    const at = shader.uniformLocations;
    const shown = this.#shown.get(this.#camera)!;
    const [map, answer] = this.#textures.units;
    this.#textures.bind(shown, 0);
    gl.uniform1i(at["hprDepths"]!, map);
    gl.uniform1i(at["hprAnswer"]!, answer);
    gl.uniform3f(at["hprViewpoint"]!, 0, 0, 0);
    gl.uniform1f(at["hprRow"] ?? null, 256 / Math.max(256, shown.map?.data.length ?? 0));
    if (shown.answer !== undefined) {
      const { bytes, size } = shown.answer;
      if (!shown.answer.isSent) {
        this.#textures.uploadBytes(bytes, bytes, size);
        shown.answer.isSent = true;
      }
      this.#textures.bind(bytes, 1);
      gl.uniform2f(at["hprSize"]!, ...size);
    }
    gl.activeTexture(gl.TEXTURE0);
    const through = Object.create(shader) as PotreeShader;
    through.setUniform1f = (name, value) => {
      shader.setUniform1f(name, value);
      if (name === "uPCIndex") this.#tell(shader, shown, nodes[value]!);
    };
    return through;
  }

  #tell({ uniformLocations: at }: PotreeShader, { map, answer, isAnswered }: Shown, node: OctreeNode): void {
    const { gl } = this.#renderer;
    const tile = this.#tiles.get(node);
    const span = isAnswered && tile !== undefined ? answer!.spans.get(tile) : undefined;
    if (span?.revision === tile?.revision && span !== undefined) {
      gl.uniform1f(at["hprMode"]!, MODE.answer);
      gl.uniform1f(at["hprFirst"]!, span.first);
      return;
    }
    const isMapped = tile !== undefined && map !== undefined && map.data.length > 0;
    gl.uniform1f(at["hprMode"]!, isMapped ? MODE.map : MODE.all);
    if (isMapped) {
      const { viewpoint, turn, margins } = map.seenIn(tile.matrix);
      gl.uniform3fv(at["hprEye"]!, viewpoint);
      gl.uniformMatrix3fv(at["hprTurn"]!, false, turn);
      gl.uniform4fv(at["hprMargins"]!, margins);
    }
  }
}
