import {
  DataTexture,
  FloatType,
  type Intersection,
  type Material,
  Matrix4,
  type Points,
  type Raycaster,
  RedFormat,
  Vector3,
  type WebGLRenderer,
} from "three";

import type { VisibilityMap } from "../cloud/visibility-map.js";
import { override } from "../base/objects.js";
import { type MapPatch, patchMaterial, type PatchMaterial } from "./map-material.js";

const WIDTH = 256;
const IDENTITY = new Matrix4();

/** A map and its texture. */
export interface MapTexture {
  readonly map: VisibilityMap;
  readonly texture: DataTexture;
}

/** The textures of the last map for each camera. Objects that draw by the same map share its texture. */
export class MapTextures {
  readonly #textures = new Map<unknown, MapTexture>();

  /** The texture of this map. */
  of(camera: unknown, map: VisibilityMap): MapTexture {
    const last = this.#textures.get(camera);
    if (last?.map === map) return last;
    const { length } = map.data;
    let texture = last?.texture;
    if (texture === undefined || texture.image.data!.length < length) {
      texture?.dispose();
      // The next maps may be somewhat larger.
      const rows = Math.ceil((1.25 * length) / WIDTH);
      texture = new DataTexture(new Float32Array(rows * WIDTH), WIDTH, rows, RedFormat, FloatType);
    }
    (texture.image.data as Float32Array).set(map.data);
    texture.needsUpdate = true;
    const made = { map, texture };
    this.#textures.set(camera, made);
    return made;
  }

  drop(camera: unknown): void {
    this.#textures.get(camera)?.texture.dispose();
    this.#textures.delete(camera);
  }

  dispose(): void {
    for (const camera of [...this.#textures.keys()]) this.drop(camera);
  }
}

/**
 * Points of which the vertex shader leaves out those that a map hides, or those that it does not. The
 * material is patched, and the map's uniforms are set only while these points are drawn, because
 * other objects may have the same material.
 */
export class MappedPoints {
  readonly #points: Points;
  readonly #patch: PatchMaterial;
  readonly #mode: 1 | -1;
  #material: MapPatch | undefined;
  #patched: unknown;
  #isRefused = false;
  #texture: MapTexture | undefined;
  #matrix: readonly number[] = IDENTITY.elements;
  #seen: ReturnType<VisibilityMap["seenIn"]> | undefined;
  #hooks: Partial<Points> | undefined;
  #restore: (() => void) | undefined;

  /** `mode` -1: only hidden points are drawn. */
  constructor(points: Points, patch: PatchMaterial, mode: 1 | -1 = 1) {
    this.#points = points;
    this.#patch = patch;
    this.#mode = mode;
  }

  /** Whether maps can be drawn. Undefined until the points were drawn once. */
  get isAble(): boolean | undefined {
    return this.#isRefused ? false : this.#material?.isPatched;
  }

  /** The map that is drawn. */
  get map(): VisibilityMap | undefined {
    return this.#texture?.map;
  }

  /** Draws with this map, or without one. `matrix` goes from the points' space to the map's. */
  show(texture: MapTexture | undefined, matrix: readonly number[] = IDENTITY.elements): void {
    this.#texture = texture;
    this.#matrix = matrix;
    this.#seen = texture?.map.seenIn(matrix);
  }

  /** Patches the material that the points have now. Called in every frame. */
  follow(): void {
    const { material } = this.#points;
    if (material !== this.#patched) {
      this.#material?.leave();
      this.#patched = material;
      this.#isRefused = Array.isArray(material) || !("onBeforeCompile" in material);
      this.#material = this.#isRefused ? undefined : this.#patch(material as Material);
    }
    this.#material?.follow();
    const [points, hooks] = [this.#points, this.#hooks];
    if (points.onBeforeRender !== hooks?.onBeforeRender || points.onAfterRender !== hooks.onAfterRender) this.#hook();
  }

  /** Everything is as before. */
  dispose(): void {
    this.show(undefined);
    this.#restore?.();
    this.#material?.leave();
    this.#material = this.#patched = undefined;
  }

  #hook(): void {
    const points = this.#points;
    const [before, after, raycast] = (["onBeforeRender", "onAfterRender", "raycast"] as const).map(
      (name) => points[name].bind(points) as (...args: unknown[]) => void,
    );
    this.#hooks = {
      onBeforeRender: (renderer: WebGLRenderer, ...others: unknown[]) => {
        before!(renderer, ...others);
        this.#begin(renderer);
      },
      onAfterRender: (renderer: WebGLRenderer, ...others: unknown[]) => {
        this.#end(renderer);
        after!(renderer, ...others);
      },
      raycast: (raycaster: Raycaster, found: Intersection[]) => {
        const first = found.length;
        raycast!(raycaster, found);
        if (this.map !== undefined) found.push(...found.splice(first).filter(({ index }) => !this.#hides(index!)));
      },
    };
    const [own, earlier] = [override(points, this.#hooks), this.#restore];
    this.#restore = () => {
      own();
      earlier?.();
    };
  }

  /** Whether the map hides the point with this number. */
  #hides(index: number): boolean {
    const { position } = this.#points.geometry.attributes;
    const at = new Vector3().fromBufferAttribute(position!, index);
    const place = at.applyMatrix4(new Matrix4().fromArray(this.#matrix));
    return this.map!.hides([place.x, place.y, place.z])[0] === 1;
  }

  #begin(renderer: WebGLRenderer): void {
    if ("isWebGPURenderer" in renderer && this.#patch === patchMaterial) {
      this.#isRefused = true;
      return;
    }
    const [material, texture, seen] = [this.#material, this.#texture, this.#seen];
    if (material?.isPatched !== true || texture === undefined || seen === undefined || texture.map.data.length === 0) {
      return;
    }
    const { hprMode, hprDepths, hprMargins, hprEye, hprTurn, hprRow } = material.uniforms;
    hprMode.value = this.#mode;
    hprDepths.value = texture.texture;
    hprRow.value = 1 / texture.texture.image.height;
    hprMargins.value.fromArray(seen.margins);
    hprEye.value.fromArray(seen.viewpoint);
    hprTurn.value.fromArray(seen.turn);
    again(renderer);
  }

  #end(renderer: WebGLRenderer): void {
    const mode = this.#material?.uniforms.hprMode;
    if (mode !== undefined && mode.value !== 0) {
      mode.value = 0;
      again(renderer);
    }
  }
}

/** The renderer sends uniforms only when the program or the material changes. So it must choose the program again. */
function again(renderer: WebGLRenderer): void {
  if ("isWebGPURenderer" in renderer) return;
  (renderer.state as { useProgram(program: WebGLProgram | null): boolean }).useProgram(null);
}
