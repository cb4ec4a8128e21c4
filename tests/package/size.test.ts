import { gzipSync } from "node:zlib";

import { expect, it } from "vitest";

import { wasmBytes } from "./support";

// What every page that uses the package downloads. Formatting of floats, a second
// compilation for another type of number, or a library for one operation each cost 10
// to 40 kB unnoticed.
//
// Of 232 kB (100 kB gzipped), views and changes of clouds in space are some 40 %, motion
// and memory included. The others are the rest of the paper and its borders: four and more
// dimensions 10 %, bindings 8 %, sectors of several workers 7 %, directions 6 %, meshes 5 %,
// pow, exp, logarithms, sine and cosine 4 %; several viewpoints, light, searches and noise
// 3 % each; panics and merging 2 % each. To inline less takes 4 to 6 kB (gzipped) off, and
// makes views 5 to 9 % slower; to unroll less takes 1 kB off and makes them 10 to 25 % slower.
// Since those shares were measured, bindings and cold code have lost 6 kB.
// Two and three looks have added 15 kB (6 kB gzipped) since.
it("the wasm stays small", () => {
  const bytes = wasmBytes();
  expect(bytes.length).toBeLessThanOrEqual(250_000);
  expect(gzipSync(bytes, { level: 9 }).length).toBeLessThanOrEqual(109_300);
});
