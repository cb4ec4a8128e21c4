import { gzipSync } from "node:zlib";

import { expect, it } from "vitest";

import { liteBytes, wasmBytes } from "./support";

// Every page that uses the package downloads the wasm. Formatting of floats, a second
// compilation for another type of number, or a library for one operation can each add 10
// to 40 kB unnoticed.
it("the wasm has at most 165 kB, gzipped", () => {
  expect(gzipSync(wasmBytes(), { level: 9 }).length).toBeLessThanOrEqual(165_000);
});

// What of the crate it leaves out stands in src/base/build.rs and src/wasm/mod.rs.
it("the wasm of the operator alone has at most 52 kB, gzipped", () => {
  expect(gzipSync(liteBytes(), { level: 9 }).length).toBeLessThanOrEqual(52_000);
});
