// The download size of the wasm, and of each entry: bundled and minified, without the wasm.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";
import { describe, expect, it } from "vitest";

import { liteBytes, wasmBytes } from "./support";

/** A page that uses an adapter already has these modules. */
const PEERS = ["three", "three/*", "react", "react/*", "@react-three/fiber", "@deck.gl/*", "copc"];

const gzipped = (bytes: Uint8Array) => gzipSync(bytes, { level: 9 }).length;

async function sizeOf(file: string): Promise<number> {
  const entry = join(import.meta.dirname, "../../dist", file);
  const { outputFiles } = await build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    format: "esm",
    write: false,
    external: PEERS,
  });
  return gzipped(outputFiles[0]!.contents);
}

// The shared code that follows a camera costs each adapter 500 bytes, and saves their worker 2,200.
// Looks and scores cost 500 bytes: two options, their refusals, and the scores of an answer.
// The choice of points (`within`) costs each 500 bytes. `follow` costs the worker client 1,800 bytes:
// its stages, its options and their refusals. Cameras and waiting nodes cost the filters 600 to 800 bytes.
// Signs of life, and workers that are replaced, cost 500 bytes; the usual `settle`, `settled` and `ready` cost 500.
// `configure`, the ways to start a worker and the words for what fails cost 400 to 700 bytes.
// Maps of directions cost 2,150 bytes: the shaders as text, and their test. To draw by them costs filters 2,600 bytes:
// the patched material, the texture, what rays meet, and the questions while the camera moves.
// Cameras as viewpoints, their two poses and `seenBy` cost 650 to 900 bytes, `transfer` 1,700,
// `orientNormals` 320, and the directions that it needs 40 to 100.
// COLMAP's models cost 170 to 240: their names and the numbers of their coefficients.
// What puts the views of workers together needs the glue of the wasm on the page, too: 4,800 bytes where it was not.
// What `lite` shares with the other entries (an engine with its glue, a cloud of either wasm) costs these 70 to 250 bytes.
it.each([
  ["index.js", 21_500],
  ["worker.js", 26_100],
  ["worker-thread.js", 9_900],
  // A refusal that names the kind of object and the way out costs 200 bytes.
  // Events of their own, a texture for shaders of the language's first version and maps for new nodes cost 300 to 500.
  ["three.js", 35_300],
  ["react-three-fiber.js", 35_800],
  ["nodes.js", 37_100],
  // Both filters, and the test as nodes.
  ["three-webgpu.js", 38_300],
  // Without three, and without what draws its points.
  ["potree.js", 34_400],
  // Degrees, meters and matrices cost 950 bytes.
  // Maps: the test in the shader and its texture cost 1,150. The view that it shares with the filters costs 150,
  // the directions of its picture 60.
  ["deck.js", 29_950],
  // The octrees themselves cost 7.5 kB (the formats, the order of the nodes, the steps), clouds and horizons the rest.
  // With the colors of points: 15,727 bytes.
  // The readers of all formats, and what writes PLY and LAS. The reader of glTF and the names of foreign files cost 6,700. Those of cameras are 5,300 bytes of it, those of E57 and PTX and
  // the loading of the wasm for E57 3,100. Arrays of NumPy, .bin of KITTI and nuScenes and points of COLMAP cost 1,300,
  // what refuses packings that hold too much 180, KITTI's raw calibration 290, bytes of Node's Buffer 40.
  ["files.js", 42_520],
  // The overview, and the wasm that reads files instead of laz-perf, cost 1,100.
  ["stream.js", 24_900],
])("%s stays below %i bytes, gzipped", async (file, limit) => {
  const size = await sizeOf(file);
  console.log(`${file}: ${size} bytes gzipped, ${size + gzipped(wasmBytes())} with the wasm`);
  expect(size).toBeLessThan(limit);
});

describe("an entry without a bundler", () => {
  const dist = join(import.meta.dirname, "../../dist");
  const importsOf = (file: string) => {
    const text = readFileSync(join(dist, file), "utf8");
    return [...text.matchAll(/^(?:import|export)\b[^;"]*"\.\/([^"]+)"/gm)].map(([, name]) => name!);
  };
  /** A file and all that it imports. A file that is met again inside itself is in a circle: it would run too early. */
  function loaded(file: string, found = new Set<string>(), inside: string[] = []): Set<string> {
    expect(inside, "a circle").not.toContain(file);
    for (const next of importsOf(file)) loaded(next, found, [...inside, file]);
    return found.add(file);
  }

  it.each([
    ["index.js", 5],
    ["lite.js", 1],
    ["worker.js", 6],
    ["files.js", 4],
    ["three.js", 7],
    ["nodes.js", 7],
    ["potree.js", 7],
    ["react-three-fiber.js", 7],
    ["three-webgpu.js", 7],
    ["deck.js", 6],
    ["stream.js", 5],
    ["inline.js", 4],
  ])("%s loads at most %i files, without circles", (file, most) => {
    const files = [...loaded(file)];
    const bytes = files.reduce((sum, name) => sum + readFileSync(join(dist, name)).length, 0);
    console.log(`${file}: ${files.length} files, ${bytes} bytes`);
    expect(files.length).toBeLessThanOrEqual(most);
    // A file that only names what others hold has no code to map.
    for (const name of files.filter((one) => !/^(three|nodes|worker|files)\.js$/.test(one))) {
      expect(readFileSync(join(dist, `${name}.map`), "utf8")).toContain('"sourcesContent"');
    }
  });
});

it("lite.js stays below 8,200 bytes, gzipped", async () => {
  const size = await sizeOf("lite.js");
  console.log(`lite.js: ${size} bytes gzipped, ${size + gzipped(liteBytes())} with its wasm`);
  expect(size).toBeLessThan(8200);
});

it("the README says how large the main entry is", async () => {
  const readme = readFileSync(join(import.meta.dirname, "../../README.md"), "utf8");
  const [, said] = /JavaScript of the main entry (\d+) kB/.exec(readme)!;
  expect(Number(said)).toBe(Math.round((await sizeOf("index.js")) / 1000));
});

it("inline.js costs little more than the main entry, the worker's script and the wasm do", async () => {
  const [inline, index, worker] = await Promise.all(["inline.js", "index.js", "worker-thread.js"].map(sizeOf));
  console.log(`inline.js: ${inline} bytes gzipped`);
  // Base64 loses a little of gzip's gain.
  expect(inline).toBeLessThan(1.05 * (index! + worker! + gzipped(wasmBytes())));
});

// Three is not in it: the filter for Potree reads the viewer's own objects.
it("the script without a bundler costs at most 17 kB more than inline.js, gzipped", async () => {
  const script = gzipped(readFileSync(join(import.meta.dirname, "../../dist/hidden-point-removal.global.js")));
  console.log(`hidden-point-removal.global.js: ${script} bytes gzipped`);
  expect(script).toBeLessThan((await sizeOf("inline.js")) + 17_000);
});

// Every page that uses the package downloads the wasm. Formatting of floats, a second
// compilation for another type of number, or a library for one operation can each add 10
// to 40 kB unnoticed.
it("the wasm has at most 165 kB, gzipped", () => {
  expect(gzipped(wasmBytes())).toBeLessThanOrEqual(165_000);
});

// What of the crate it leaves out stands in src/base/build.rs and src/wasm/mod.rs.
it("the wasm of the operator alone has at most 52 kB, gzipped", () => {
  expect(gzipped(liteBytes())).toBeLessThanOrEqual(52_000);
});
