// node answers.mjs PACKAGE CASES.json: the answers of the npm package, a digest a line.
// Each case: { file, precision, call, arguments }. `test_bits.py` asks the same in Python.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [, , packagePath, casesPath] = process.argv;
const { init, PointCloud } = await import(pathToFileURL(packagePath).href);
await init();

/** The bytes of one answer after another. */
function digest(...arrays) {
  const hash = createHash("sha256");
  for (const array of arrays) hash.update(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
  return hash.digest("hex");
}

function answer({ file, precision, call, arguments: given }) {
  const bytes = readFileSync(file).buffer;
  const cloud = new PointCloud(precision === "single" ? new Float32Array(bytes) : new Float64Array(bytes));
  try {
    const result = cloud[call](...given);
    if (result instanceof Float32Array) return digest(result);
    const numbers = new Float64Array([result.radius, result.exponent]);
    return digest(result.indices, numbers, result.scores ?? new Float32Array(), result.triangles ?? new Uint32Array());
  } finally {
    cloud.dispose();
  }
}

for (const one of JSON.parse(readFileSync(casesPath, "utf8"))) console.log(answer(one));
