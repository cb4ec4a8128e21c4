import { allocating } from "../base/memory.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";

type Context = WebGLRenderingContext | WebGL2RenderingContext;

/** The texture of maps and that of answers, in Potree's own context. It may be one of WebGL 1. */
export class Textures {
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
