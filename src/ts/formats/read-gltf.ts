import {
  type BufferAttribute,
  type BufferGeometry,
  Color,
  type InstancedMesh,
  type InterleavedBufferAttribute,
  LoadingManager,
  Matrix4,
  type Mesh,
  MeshBasicMaterial,
  type Object3D,
  SRGBColorSpace,
  Vector3,
} from "three";
import { type GLTF, GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { CloudBuilder } from "./builder.js";
import type { CloudFile, Reading } from "./cloud-file.js";
import type { Column } from "./column.js";
import { FormatProblem } from "./problem.js";
import { step } from "./read-rows.js";
import { viewOf, wholeFile } from "./source.js";

type Attribute = BufferAttribute | InterleavedBufferAttribute;

interface GltfJson {
  asset?: { version?: unknown };
  buffers?: { uri?: string }[];
  extensionsUsed?: string[];
  extensionsRequired?: string[];
}

/** Extensions that a file may require: three's loader supports them, or they do not change where points are. */
const UNDERSTOOD =
  /^(KHR_(mesh_quantization|meshopt_compression|materials_|texture_|lights_|animation_|xmp)|EXT_(meshopt_compression|mesh_gpu_instancing|texture_))/;

/** An object with vertices in a scene, and its places: one for each of its instances. */
interface Placed {
  geometry: BufferGeometry;
  matrices: Matrix4[];
}

/** The vertices of a glTF scene, of points and of meshes, placed by its nodes. */
export async function readGltf(reading: Reading): Promise<CloudFile> {
  const data = await wholeFile(reading.source);
  checkUse(jsonOf(data), reading.base);
  const placed = verticesIn(await parse(data, reading.base));
  const total = placed.reduce((sum, each) => sum + each.matrices.length * position(each).count, 0);

  const colored = placed.length > 0 && placed.every(({ geometry }) => "color" in geometry.attributes);
  const extras = extraColumns(placed);
  const columns: Column[] = [
    ...(colored ? ["red", "green", "blue"].map((column): Column => ({ name: column, type: "uint8" })) : []),
    ...extras,
  ];
  const builder = new CloudBuilder("float64", columns, reading, total);
  const first = colored ? 3 : 0;
  const point = new Vector3();
  const shown = { r: 0, g: 0, b: 0 };
  for (const each of placed) {
    const attributes = each.geometry.attributes as Record<string, Attribute>;
    const positions = position(each);
    for (const matrix of each.matrices) {
      step(reading, (reading.source.size * builder.rows) / Math.max(1, total));
      for (let vertex = 0; vertex < positions.count; vertex++) {
        if (!builder.takes()) continue;
        point.fromBufferAttribute(positions, vertex).applyMatrix4(matrix);
        const i = builder.put(point.x, point.y, point.z);
        if (colored) {
          // The colors in a file are linear light.
          new Color().fromBufferAttribute(attributes["color"] as BufferAttribute, vertex).getRGB(shown, SRGBColorSpace);
          [shown.r, shown.g, shown.b].forEach(
            (value, channel) => (builder.values[channel]![i] = Math.round(255 * Math.min(1, Math.max(0, value)))),
          );
        }
        extras.forEach((extra, k) => (builder.values[first + k]![i] = attributes[extra.attribute]!.getX(vertex)));
      }
    }
  }
  if (builder.rows === 0) throw new FormatProblem("its scene has no vertices");
  return { ...builder.finish(), up: "y", unit: { name: "m", meters: 1 } };
}

/** The description of the scene: the whole file, or the first part of a binary file. */
function jsonOf(data: Uint8Array): GltfJson {
  const view = viewOf(data);
  const binary = view.byteLength >= 20 && view.getUint32(0, true) === 0x46546c67;
  if (binary && view.getUint32(4, true) !== 2) {
    throw new FormatProblem(`its glTF version is ${view.getUint32(4, true)}, and only version 2 is read`);
  }
  if (binary && view.getUint32(8, true) > view.byteLength) {
    throw new FormatProblem("it is shorter than its header says");
  }
  const end = binary ? 20 + view.getUint32(12, true) : data.length;
  try {
    return JSON.parse(new TextDecoder().decode(data.subarray(binary ? 20 : 0, end))) as GltfJson;
  } catch (cause) {
    throw new FormatProblem("the description of its scene cannot be read", { cause });
  }
}

function checkUse(json: GltfJson, base: string | undefined): void {
  if (json.asset?.version === undefined) throw new FormatProblem("it does not give its glTF version");
  const used = [...(json.extensionsUsed ?? []), ...(json.extensionsRequired ?? [])];
  if (used.includes("KHR_draco_mesh_compression")) {
    throw new FormatProblem("it is compressed with Draco, which is not read; export it without that compression");
  }
  const unknown = json.extensionsRequired?.find((extension) => !UNDERSTOOD.test(extension));
  if (unknown !== undefined) throw new FormatProblem(`it needs an extension that is not supported (${unknown})`);
  const elsewhere = json.buffers?.find(({ uri }) => uri !== undefined && !uri.startsWith("data:"));
  if (elsewhere && base === undefined) {
    throw new FormatProblem(`it keeps its points in another file (${elsewhere.uri}); export it as one GLB file`);
  }
}

async function parse(data: Uint8Array<ArrayBuffer>, base = ""): Promise<GLTF> {
  const loader = new GLTFLoader(new LoadingManager()).setMeshoptDecoder(MeshoptDecoder);
  // Only vertices are needed, so no textures are loaded, nor other data for materials.
  loader.register(() => ({ name: "no_materials", loadMaterial: () => Promise.resolve(new MeshBasicMaterial()) }));
  try {
    return await loader.parseAsync(data.slice().buffer, base);
  } catch (cause) {
    const why = cause instanceof Error ? cause.message.replace(/^THREE\.\w+: |\.$/g, "") : "it could not be read";
    throw new FormatProblem(`it is broken or uses a feature that is not supported: ${why}`, { cause });
  }
}

function verticesIn({ scene, scenes }: GLTF): Placed[] {
  const placed: Placed[] = [];
  const root = (scene as Object3D | undefined) ?? scenes[0];
  root?.updateMatrixWorld(true);
  root?.traverse((object) => {
    // Points and lines also have a geometry.
    const { geometry } = object as Partial<Mesh>;
    if (!geometry || !("position" in geometry.attributes)) return;
    placed.push({ geometry, matrices: isInstanced(object) ? instances(object) : [object.matrixWorld] });
  });
  return placed;
}

function isInstanced(object: Object3D): object is InstancedMesh {
  return "isInstancedMesh" in object;
}

function instances(mesh: InstancedMesh): Matrix4[] {
  return Array.from({ length: mesh.count }, (_, i) => {
    const matrix = new Matrix4();
    mesh.getMatrixAt(i, matrix);
    return matrix.premultiply(mesh.matrixWorld);
  });
}

function position({ geometry }: Placed): BufferAttribute {
  return geometry.getAttribute("position") as BufferAttribute;
}

/** The file's own numbers, such as “_INTENSITY”, if all vertices have them. */
function extraColumns(placed: readonly Placed[]): (Column & { attribute: string })[] {
  const names = Object.keys(placed[0]?.geometry.attributes ?? {}).filter((name) => name.startsWith("_"));
  return names
    .filter((name) =>
      placed.every(
        ({ geometry }) => (geometry.attributes as Record<string, Attribute | undefined>)[name]?.itemSize === 1,
      ),
    )
    .map((attribute) => ({ name: attribute.slice(1), attribute, type: "float32" }));
}
