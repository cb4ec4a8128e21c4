import { gzipSync } from "node:zlib";

import { expect, it } from "vitest";

import { wasmBytes } from "./support";

// Every page that uses the package downloads the wasm. Formatting of floats, a second
// compilation for another type of number, or a library for one operation can each add 10
// to 40 kB unnoticed.
//
// The shares of 232 kB (100 kB gzipped): views and changes of clouds in space some 40 %,
// with motion and memory; four and more dimensions 10 %; bindings 8 %; sectors of several
// workers 7 %; directions 6 %; meshes 5 %; pow, exp, logarithms, sine and cosine 4 %;
// several viewpoints, light, searches and noise 3 % each; panics and merging 2 % each.
// Less inlining saves 4 to 6 kB (gzipped), and makes views 5 to 9 % slower. Less unrolling
// saves 1 kB, and makes views 10 to 25 % slower.
// After these shares were measured, bindings and cold code lost 6 kB, and two and three
// looks added 15 kB (6 kB gzipped). Drafts and samples added 14 kB (6 kB gzipped).
// The choice of points (`within`) added 8 kB (4.2 kB gzipped). Exact views in slices added
// 2 kB (1.3 kB gzipped). `sees` added 20 kB (9 kB gzipped), a third of it the kept hull. Cameras added 7 kB
// (3 kB gzipped). The ring that certifies a sector added 9 kB (3.5 kB gzipped). New numbers for moving hulls and the
// present rule of looks added 16 kB (5 kB gzipped). Horizons added 10 kB (3.5 kB gzipped). A lower inline threshold saves 4 kB and makes views 3 to 5 % slower.
it("the wasm stays small", () => {
  const bytes = wasmBytes();
  expect(bytes.length).toBeLessThanOrEqual(334_500);
  expect(gzipSync(bytes, { level: 9 }).length).toBeLessThanOrEqual(145_500);
});
