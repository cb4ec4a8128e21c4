import { gzipSync } from "node:zlib";

import { expect, it } from "vitest";

import { wasmBytes } from "./support";

// What every page that uses the package downloads. Formatting of floats, a second
// compilation for another type of number, or a library for one operation each cost 10
// to 40 kB unnoticed.
//
// Of 272 kB (116 kB gzipped), views and changes of clouds in space are 169 kB. The others
// are the rest of the paper: inversions with their pow, exp and logarithms, both searches,
// noise, several viewpoints, directions, meshes, light, and four and more dimensions.
it("the wasm stays small", () => {
  const bytes = wasmBytes();
  expect(bytes.length).toBeLessThanOrEqual(278_000);
  expect(gzipSync(bytes, { level: 9 }).length).toBeLessThanOrEqual(119_000);
});
