import { type DataTexture, type IUniform, type Material, Matrix3, Vector3, Vector4, type WebGLRenderer } from "three";

import { withTest } from "./map-shader.js";

/** The uniforms that a patched material has. They are set for each object, right before it is drawn. */
export interface MapUniforms {
  /** 0: all points are drawn. 1: those that are not hidden. -1: those that are hidden. */
  hprMode: IUniform<number>;
  hprDepths: IUniform<DataTexture | null>;
  hprMargins: IUniform<Vector4>;
  hprViewpoint: IUniform<Vector3>;
  /** The viewpoint in the space of the points, and the turn from there to the space of the map. */
  hprEye: IUniform<Vector3>;
  hprTurn: IUniform<Matrix3>;
  /** The height of a texel, as a share of the texture's. */
  hprRow: IUniform<number>;
}

export function mapUniforms(): MapUniforms {
  return {
    hprMode: { value: 0 },
    hprDepths: { value: null },
    hprMargins: { value: new Vector4() },
    hprViewpoint: { value: new Vector3() },
    hprEye: { value: new Vector3() },
    hprTurn: { value: new Matrix3() },
    hprRow: { value: 1 },
  };
}

/** A material that can leave out hidden points, as `uniforms` say. */
export interface MapPatch {
  readonly uniforms: MapUniforms;
  /** Whether its shader was patched. Undefined until it is compiled. */
  readonly isPatched: boolean | undefined;
  /** Patches the material again if somebody else has patched it. Called in every frame. */
  follow(): void;
  /** One user less. With the last one, the material is as it was before. */
  leave(): void;
}

/** Patches a material for one more user. */
export type PatchMaterial = (material: Material) => MapPatch;

type Shader = Parameters<Material["onBeforeCompile"]>[0];
type Patched = Material & { uniforms?: Record<string, IUniform> };

/** A hidden point is moved out of the picture before anything else is computed for it. */
const MAIN = `
void main() {
  if (hprMode != 0.0 && (hprMode > 0.0) == hprHidden(hprTurn * (position - hprEye))) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  hprMain();
}
`;

/** A material whose vertex shader can leave out hidden points. Filters that share a material share this. */
export class MapMaterial implements MapPatch {
  readonly uniforms = mapUniforms();
  isPatched: boolean | undefined;
  readonly #material: Patched;
  #users = 0;
  #compile!: Material["onBeforeCompile"];
  #key!: Material["customProgramCacheKey"];
  #restore: (() => void) | undefined;

  static readonly #known = new WeakMap<Material, MapMaterial>();

  private constructor(material: Material) {
    this.#material = material;
  }

  /** The patch of this material, for one more user. */
  static readonly of = (material: Material): MapMaterial => {
    const known = MapMaterial.#known.get(material) ?? new MapMaterial(material);
    MapMaterial.#known.set(material, known);
    known.#users += 1;
    return known;
  };

  follow(): void {
    if (this.#material.onBeforeCompile !== this.#compile || this.#material.customProgramCacheKey !== this.#key) {
      this.#patch();
    }
  }

  leave(): void {
    this.#users -= 1;
    if (this.#users > 0) {
      return;
    }
    MapMaterial.#known.delete(this.#material);
    this.#restore?.();
    this.#material.needsUpdate = true;
  }

  #patch(): void {
    const material = this.#material;
    const owns = (name: string) => Object.prototype.hasOwnProperty.call(material, name);
    const [hadCompile, hadKey] = [owns("onBeforeCompile"), owns("customProgramCacheKey")];
    // oxlint-disable-next-line typescript/unbound-method -- called with the material
    const { onBeforeCompile, customProgramCacheKey } = material;
    const compile = (shader: Shader, renderer: WebGLRenderer) => {
      onBeforeCompile.call(material, shader, renderer);
      if (this.#users > 0) this.#change(shader, renderer);
    };
    // By default, the key is the text of `onBeforeCompile`: here, that of the material's own one.
    const key = () => {
      const before = customProgramCacheKey.call(
        Object.create(material, { onBeforeCompile: { value: onBeforeCompile } }),
      );
      return `${before}${this.#users > 0 ? " hprHidden" : ""}`;
    };
    material.onBeforeCompile = this.#compile = compile;
    material.customProgramCacheKey = this.#key = key;
    material.needsUpdate = true;
    this.#restore = () => {
      if (material.onBeforeCompile === compile) {
        if (hadCompile) {
          material.onBeforeCompile = onBeforeCompile;
        } else {
          delete (material as Partial<Material>).onBeforeCompile;
        }
      }
      if (material.customProgramCacheKey === key) {
        if (hadKey) {
          material.customProgramCacheKey = customProgramCacheKey;
        } else {
          delete (material as Partial<Material>).customProgramCacheKey;
        }
      }
      for (const name of Object.keys(this.uniforms)) {
        if (material.uniforms?.[name] === this.uniforms[name as keyof MapUniforms]) {
          Reflect.deleteProperty(material.uniforms, name);
        }
      }
    };
  }

  #change(shader: Shader, renderer: WebGLRenderer): void {
    const isPatched = shader.vertexShader.includes("hprHidden");
    const text = isPatched ? shader.vertexShader : withTest(shader.vertexShader, MAIN);
    if (text === undefined || (renderer.capabilities as { isWebGL2?: boolean }).isWebGL2 === false) {
      this.isPatched = false;
      return;
    }
    shader.vertexShader = text;
    Object.assign(shader.uniforms, this.uniforms);
    this.isPatched = true;
  }
}
