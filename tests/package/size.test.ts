import { gzipSync } from "node:zlib";

import { expect, it } from "vitest";

import { wasmBytes } from "./support";

// What every page that uses the package downloads. Formatting of floats, a second
// compilation for another type of number, or a library for one operation each cost 10
// to 40 kB unnoticed.
it("the wasm stays small", () => {
  const bytes = wasmBytes();
  expect(bytes.length).toBeLessThanOrEqual(100_000);
  expect(gzipSync(bytes, { level: 9 }).length).toBeLessThanOrEqual(44_000);
});
