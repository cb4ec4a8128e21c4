// What a page downloads for each entry, bundled and minified, without what it does not use
// and beside the wasm, which tests/package/size.test.ts weighs.
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";
import { expect, it } from "vitest";

import { wasmBytes } from "./support";

/** What a page that uses an adapter has anyway. */
const PEERS = ["three", "react", "react/*", "@react-three/fiber", "@deck.gl/*"];

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

it.each([
  ["index.js", 10_000],
  ["worker.js", 8600],
  ["worker/worker-thread.js", 6800],
  ["three.js", 18_500],
  ["react-three-fiber.js", 19_000],
  ["nodes.js", 21_000],
  ["deck.js", 11_000],
])("%s stays below %i bytes, gzipped", async (file, limit) => {
  const size = await sizeOf(file);
  console.log(`${file}: ${size} bytes gzipped, ${size + gzipped(wasmBytes())} with the wasm`);
  expect(size).toBeLessThan(limit);
});

it("inline.js costs little more than the main entry and the wasm do", async () => {
  const [inline, index] = [await sizeOf("inline.js"), await sizeOf("index.js")];
  console.log(`inline.js: ${inline} bytes gzipped`);
  // Base64 gives up a little of what gzip gains.
  expect(inline).toBeLessThan(1.05 * (index + gzipped(wasmBytes())));
});
