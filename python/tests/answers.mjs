// node answers.mjs PACKAGE CASES.json: the answers of the npm package, a digest a line.
// Each case: { file, precision, call, arguments }. `test_bits.py` asks the same in Python.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [, , packagePath, casesPath] = process.argv;
const { Horizon, init, mergeVisible, orientNormals, PointCloud, transfer } = await import(
  pathToFileURL(packagePath).href
);
await init();

/** The bytes of one answer after another. */
function digest(...arrays) {
  const hash = createHash("sha256");
  for (const array of arrays) hash.update(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
  return hash.digest("hex");
}

/** The points that a horizon of every fifth point leaves, its own, the boxes that it hides, and what is visible of all. */
function merged(positions, [viewpoint, options]) {
  const at = (i) => positions.subarray(3 * i, 3 * i + 3);
  const horizon = new Horizon(viewpoint, options);
  const all = Array.from({ length: positions.length / 3 }, (_, i) => i);
  horizon.add(all.filter((i) => i % 5 === 0).flatMap((i) => [...at(i)]));
  const ids = horizon.screen(positions);
  const corners = (i, by) => Array.from(at(i), (x) => x + by);
  const hidden = Uint8Array.from(all.slice(0, 99), (i) => horizon.hidesBox(corners(i, -0.01), corners(i, 0.01)));
  const part = { positions: positions.constructor.from([...ids].flatMap((i) => [...at(i)])), ids };
  return digest(ids, Float64Array.from(horizon.visible()), hidden, mergeVisible([part], viewpoint, options));
}

function ask(cloud, call, given) {
  if (call === "hides") return cloud.visibilityMap(...given);
  if (call === "orientNormals") return orientNormals(Float64Array.from(given[0]), cloud.seenBy(given[1]));
  if (call !== "transfer") return cloud[call](...given);
  const [cameras, images, options] = given;
  const typed = images.map(({ type, data, ...size }) => ({
    ...size,
    data: globalThis[type].from(data, (value) => value ?? NaN),
  }));
  return transfer(cloud, cameras, typed, options);
}

function answer({ file, precision, call, arguments: given }) {
  const bytes = readFileSync(file).buffer;
  const positions = precision === "single" ? new Float32Array(bytes) : new Float64Array(bytes);
  if (call === "merge") return merged(positions, given);
  const cloud = new PointCloud(positions);
  try {
    if (call === "survey") {
      return digest(Float64Array.of(cloud.spacing, cloud.noise), new TextEncoder().encode(cloud.surface));
    }
    const result = ask(cloud, call, given);
    if (ArrayBuffer.isView(result)) return digest(result);
    if (call === "hides") return digest(result.hides(positions));
    if ("recall" in result) return digest(Float64Array.of(result.thickness, result.shown, ...result.recall));
    if ("ranges" in result) {
      return digest(result.ranges, result.indices, Float64Array.of(result.skyViewFactor, result.solidAngle));
    }
    if ("pixels" in result && "depths" in result) return digest(result.indices, result.pixels, result.depths);
    if ("offsets" in result) return digest(result.offsets, result.cameras, result.pixels, result.towards);
    if ("values" in result) return digest(Float32Array.from(result.values), result.seen);
    if ("uniforms" in result) return digest(result.data, Float64Array.from(Object.values(result.uniforms).flat()));
    if ("gains" in result) {
      return digest(Float64Array.of(...result.chosen, ...result.gains), result.seen, result.unseen);
    }
    const numbers = new Float64Array([result.radius, result.exponent]);
    return digest(result.indices, numbers, result.scores ?? new Float32Array(), result.triangles ?? new Uint32Array());
  } finally {
    cloud.dispose();
  }
}

for (const one of JSON.parse(readFileSync(casesPath, "utf8"))) console.log(answer(one));
