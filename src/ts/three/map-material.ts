import { type DataTexture, type IUniform, type Material, Matrix3, Vector3, Vector4, type WebGLRenderer } from "three";

import { override } from "../base/objects.js";
import { withTest } from "./map-shader.js";

/** The uniforms that a patched material has. They are set for each object, right before it is drawn. */
interface MapUniforms {
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

function mapUniforms(): MapUniforms {
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

/** A material that can leave out hidden points, as `uniforms` say. Filters that share a material share this. */
export abstract class MapPatch {
  readonly uniforms = mapUniforms();
  /** How many draw with it. */
  users = 0;
  /** Whether its shader was patched. Undefined until it is compiled. */
  abstract readonly isPatched: boolean | undefined;
  protected readonly material: Material;
  /** Makes the material what it was before. */
  protected restore: (() => void) | undefined;

  constructor(material: Material) {
    this.material = material;
  }

  /** Patches the material again if somebody else has patched it. Called in every frame. */
  abstract follow(): void;

  /** One user less. With the last one, the material is as it was before. */
  leave(): void {
    this.users -= 1;
    if (this.users === 0) {
      this.restore?.();
      this.material.needsUpdate = true;
    }
  }
}

/** Patches a material for one more user. */
export type PatchMaterial = (material: Material) => MapPatch;

const known = new WeakMap<Material, MapPatch>();

/** Whether a filter has patched this material. */
export function isPatched(material: Material): boolean {
  return (known.get(material)?.users ?? 0) > 0;
}

/** Patches each material once. */
export function patching(Patch: new (material: Material) => MapPatch): PatchMaterial {
  return (material) => {
    const patch = known.get(material) ?? new Patch(material);
    known.set(material, patch);
    patch.users += 1;
    return patch;
  };
}

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

class MapMaterial extends MapPatch {
  isPatched: boolean | undefined;
  #compile: Material["onBeforeCompile"] | undefined;
  #key: Material["customProgramCacheKey"] | undefined;

  follow(): void {
    const { material } = this;
    if (material.onBeforeCompile === this.#compile && material.customProgramCacheKey === this.#key) return;
    // oxlint-disable-next-line typescript/unbound-method -- called with the material
    const { onBeforeCompile, customProgramCacheKey } = material;
    this.#compile = (shader, renderer) => {
      onBeforeCompile.call(material, shader, renderer);
      if (this.users > 0) this.#change(shader, renderer);
    };
    // By default, the key is the text of `onBeforeCompile`: here, that of the material's own one.
    this.#key = () => {
      const before = customProgramCacheKey.call(
        Object.create(material, { onBeforeCompile: { value: onBeforeCompile } }),
      );
      return `${before}${this.users > 0 ? " hprHidden" : ""}`;
    };
    const restore = override(material, { onBeforeCompile: this.#compile, customProgramCacheKey: this.#key });
    material.needsUpdate = true;
    this.restore = () => {
      restore();
      const { uniforms = {} } = material as Patched;
      for (const [name, own] of Object.entries(this.uniforms)) {
        if (uniforms[name] === own) Reflect.deleteProperty(uniforms, name);
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

/** Makes the vertex shaders of a material leave out hidden points. */
export const patchMaterial = patching(MapMaterial);
