// The numbers of a glTF file: buffers, views of them, and accessors.
import type { Reading } from "./cloud-file.js";
import { bytesOf, numberReader, type NumberType } from "./numbers.js";
import { FormatProblem } from "./problem.js";
import { isTooMuch, viewOf } from "./source.js";

interface BufferView {
  buffer: number;
  byteOffset?: number;
  byteLength: number;
  byteStride?: number;
  extensions?: Record<string, Meshopt | undefined>;
}

interface Meshopt {
  buffer: number;
  byteOffset?: number;
  byteLength: number;
  byteStride: number;
  count: number;
  mode: string;
  filter?: string;
}

export interface Accessor {
  bufferView?: number;
  byteOffset?: number;
  componentType: number;
  count: number;
  type: string;
  normalized?: boolean;
  sparse?: {
    count: number;
    indices: { bufferView: number; byteOffset?: number; componentType: number };
    values: { bufferView: number; byteOffset?: number };
  };
}

export interface GltfJson {
  buffers?: { uri?: string; byteLength?: number }[];
  bufferViews?: BufferView[];
  accessors?: Accessor[];
}

/** The numbers of an accessor. */
export interface Numbers {
  count: number;
  at: (index: number, component: number) => number;
}

const TYPES: Readonly<Record<number, NumberType>> = {
  5120: "int8", 5121: "uint8", 5122: "int16", 5123: "uint16", 5125: "uint32", 5126: "float32",
}; // prettier-ignore
const WIDTHS = new Map([["SCALAR", 1], ["VEC2", 2], ["VEC3", 3], ["VEC4", 4], ["MAT2", 4], ["MAT3", 9], ["MAT4", 16]]); // prettier-ignore
const MESHOPT = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

export class GltfData {
  /** The bytes of the files beside. */
  readonly bytesBeside: number;
  readonly #json: GltfJson;
  readonly #buffers: readonly (Uint8Array<ArrayBuffer> | undefined)[];
  /** Compressed views of buffers, and the bytes of all of them. */
  readonly #views = new Map<Meshopt, Promise<Uint8Array>>();
  #unpackedBytes = 0;

  private constructor(json: GltfJson, buffers: readonly (Uint8Array<ArrayBuffer> | undefined)[], bytesBeside: number) {
    [this.#json, this.#buffers, this.bytesBeside] = [json, buffers, bytesBeside];
  }

  /** @param rest the first buffer, if the file holds it */
  static async open(
    json: GltfJson,
    rest: Uint8Array<ArrayBuffer> | undefined,
    beside: Reading["beside"],
  ): Promise<GltfData> {
    const buffers: (Uint8Array<ArrayBuffer> | undefined)[] = [];
    let bytesBeside = 0;
    for (const [i, { uri }] of (json.buffers ?? []).entries()) {
      if (uri === undefined) {
        buffers.push(i === 0 ? rest : undefined);
      } else if (/^data:/i.test(uri)) {
        buffers.push(embedded(uri));
      } else {
        const bytes = await fileBeside(uri, beside);
        bytesBeside += bytes.length;
        buffers.push(bytes);
      }
    }
    return new GltfData(json, buffers, bytesBeside);
  }

  /** How many vertices these attributes describe: as many as all of them have. */
  countOf(attributes: Record<string, number>): number {
    const { count } = this.#accessor(attributes["POSITION"]!);
    for (const [name, at] of Object.entries(attributes)) {
      if (!/^(POSITION|COLOR_0|_.*)$/.test(name)) continue;
      const accessor = this.#accessor(at);
      if (accessor.count !== count) {
        throw new FormatProblem(`its accessor ${at} has ${accessor.count} values for ${count} vertices`);
      }
      // Without a view, an accessor promises any number of zeros.
      if (accessor.bufferView === undefined && accessor.sparse === undefined) {
        throw new FormatProblem(`its accessor ${at} promises ${count} values and holds none`);
      }
    }
    return count;
  }

  async numbers(at: number): Promise<Numbers> {
    const { bufferView, byteOffset = 0, componentType, count, type, normalized, sparse } = this.#accessor(at);
    const number = TYPES[componentType];
    const width = WIDTHS.get(type);
    if (number === undefined || width === undefined) throw new FormatProblem(`its accessor ${at} has no known type`);
    const size = bytesOf(number);
    const scale =
      normalized === true && number !== "float32" ? 2 ** (8 * size - (number.startsWith("u") ? 0 : 1)) - 1 : 1;
    const read = numberReader(number, 0, true);
    const value = (view: DataView, place: number) =>
      Math.max(read(view, place) / scale, number.startsWith("u") || scale === 1 ? -Infinity : -1);
    const dense = bufferView === undefined ? undefined : await this.#view(bufferView);
    const stride = dense?.stride ?? width * size;
    if (dense && byteOffset + (count - 1) * stride + width * size > dense.view.byteLength) {
      throw new FormatProblem(`its accessor ${at} promises ${count} values, more than its bytes hold`);
    }
    const others = sparse && (await this.#sparse(sparse, width * size));
    return {
      count,
      at: (index, component) => {
        const other = others?.places.get(index);
        if (other !== undefined) return value(others!.view, other + component * size);
        return dense ? value(dense.view, byteOffset + index * stride + component * size) : 0;
      },
    };
  }

  async #sparse({ count, indices, values }: NonNullable<Accessor["sparse"]>, size: number) {
    const type = TYPES[indices.componentType] ?? "uint32";
    const [places, view] = [(await this.#view(indices.bufferView)).view, (await this.#view(values.bufferView)).view];
    const [from, first] = [indices.byteOffset ?? 0, values.byteOffset ?? 0];
    if (from + count * bytesOf(type) > places.byteLength || first + count * size > view.byteLength) {
      throw new FormatProblem("a sparse accessor promises more values than its bytes hold");
    }
    const read = numberReader(type, from, true);
    const found = Array.from({ length: count }, (_, i): [number, number] => [
      read(places, i * bytesOf(type)),
      first + i * size,
    ]);
    return { view, places: new Map(found) };
  }

  #accessor(at: number): Accessor {
    const accessor = this.#json.accessors?.[at];
    if (accessor === undefined || !Number.isSafeInteger(accessor.count) || accessor.count < 1) {
      throw new FormatProblem(`its accessor ${at} is missing, or has no count`);
    }
    const least = accessor.sparse ? accessor.sparse.count : 0;
    // Zeros that a sparse accessor leaves out are not stored.
    if (accessor.bufferView === undefined && accessor.count > 1000 * Math.max(1, least)) {
      throw new FormatProblem(`its accessor ${at} promises ${accessor.count} values and holds ${least}`);
    }
    return accessor;
  }

  async #view(at: number): Promise<{ view: DataView; stride: number | undefined }> {
    const given = this.#json.bufferViews?.[at];
    if (given === undefined) throw new FormatProblem(`its bufferView ${at} is missing`);
    const packed = MESHOPT.map((name) => given.extensions?.[name]).find((each) => each !== undefined);
    if (packed !== undefined) {
      const bytes = this.#views.get(packed) ?? this.#unpacked(packed);
      this.#views.set(packed, bytes);
      return { view: viewOf(await bytes), stride: packed.byteStride };
    }
    return { view: viewOf(this.#bytes(given)), stride: given.byteStride };
  }

  #bytes({ buffer, byteOffset = 0, byteLength }: Pick<BufferView, "buffer" | "byteOffset" | "byteLength">): Uint8Array {
    const bytes = this.#buffers[buffer];
    if (bytes === undefined || !(byteOffset >= 0 && byteLength >= 0 && byteOffset + byteLength <= bytes.length)) {
      throw new FormatProblem(`its buffer ${buffer} is missing, or shorter than a bufferView says`);
    }
    return bytes.subarray(byteOffset, byteOffset + byteLength);
  }

  async #unpacked(packed: Meshopt): Promise<Uint8Array> {
    const source = this.#bytes(packed);
    const { count, byteStride, mode, filter } = packed;
    const size = count * byteStride;
    this.#unpackedBytes += size;
    const held = this.#buffers.reduce((sum, bytes) => sum + (bytes?.length ?? 0), 0);
    if (!(size > 0) || isTooMuch(this.#unpackedBytes, held)) {
      throw new FormatProblem(`its compressed views promise ${this.#unpackedBytes} bytes in ${held}`);
    }
    const { MeshoptDecoder } = await import("three/addons/libs/meshopt_decoder.module.js").catch((cause: unknown) => {
      throw new FormatProblem("it is compressed with meshopt, which needs the package three: npm install three", {
        cause,
      });
    });
    await MeshoptDecoder.ready;
    const target = new Uint8Array(size);
    try {
      MeshoptDecoder.decodeGltfBuffer(target, count, byteStride, source, mode, filter);
    } catch (cause) {
      throw new FormatProblem("its points, compressed with meshopt, are damaged", { cause });
    }
    return target;
  }
}

/** The bytes in an address that holds them. */
function embedded(uri: string): Uint8Array<ArrayBuffer> {
  const [, isBase64, text] = /^data:[^,]*?(;base64)?,(.*)$/is.exec(uri) ?? [];
  try {
    const bytes = isBase64 === undefined ? decodeURIComponent(text!) : atob(text!);
    return Uint8Array.from(bytes, (char) => char.charCodeAt(0));
  } catch (cause) {
    throw new FormatProblem("the data in its description are damaged", { cause });
  }
}

/** A file in the folder of the description, and in none above. */
async function fileBeside(uri: string, beside: Reading["beside"]): Promise<Uint8Array<ArrayBuffer>> {
  if (beside === undefined) {
    throw new FormatProblem(`it keeps its points in another file (${uri}); export it as one GLB file`);
  }
  let name: string;
  try {
    name = decodeURIComponent(uri);
  } catch (cause) {
    throw new FormatProblem(`the name of its other file cannot be read (${uri})`, { cause });
  }
  if (/^[a-z][a-z0-9+.-]*:|^[/\\]|(^|[/\\])\.\.([/\\]|$)/i.test(name)) {
    throw new FormatProblem(`it keeps its points in ${uri}, which is not beside it; only files beside it are read`);
  }
  return beside(name);
}
