// node answers.mjs PACKAGE CASES.json: the answers of the npm package, a digest a line.
// Each case: { file, precision, call, arguments }. `test_bits.py` asks the same in Python.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [, , packagePath, casesPath] = process.argv;
const { init, orientNormals, PointCloud, transfer } = await import(pathToFileURL(packagePath).href);
await init();

/** The bytes of one answer after another. */
function digest(...arrays) {
  const hash = createHash("sha256");
  for (const array of arrays) hash.update(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
  return hash.digest("hex");
}

function ask(cloud, call, given) {
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
  const cloud = new PointCloud(precision === "single" ? new Float32Array(bytes) : new Float64Array(bytes));
  try {
    const result = ask(cloud, call, given);
    if (ArrayBuffer.isView(result)) return digest(result);
    if ("recall" in result) return digest(Float64Array.of(result.thickness, ...result.recall));
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
