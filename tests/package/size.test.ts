import { gzipSync } from "node:zlib";

import { expect, it } from "vitest";

import { liteBytes, wasmBytes } from "./support";

// Every page that uses the package downloads the wasm. Formatting of floats, a second
// compilation for another type of number, or a library for one operation can each add 10
// to 40 kB unnoticed.
//
// What costs bytes or speed, measured (gzipped): a limit of 50 for inlining saves 4 kB, and makes views 5 % slower
// unless the functions in the hot loops are marked #[inline]. A limit of 5 saves 1.9 kB more, and views take 0 to 3 % longer. Large functions with one caller, left as they
// are by wasm-opt, save 1.5 kB. Compiled with opt-level 2, the wasm is 4.7 kB smaller than with 3, and views take as long; with "z" 16 kB, and views take
// 3.4 times as long. With "s" for the crate that is linked alone, 5.3 kB less, and cold views take 0.98 times as long, drafts 1.01, sectors 1.02;
// with "s" for the library and 2 for what is linked, 10 kB less, and 1.04 to 1.19 times as long. Functions in the order of their names save 1 kB. Less unrolling saves 1 kB, and makes views 10 to 25 % slower. Panics without messages
// and the places in the code that they name save 7.3 kB. The pose of a camera, and whether it is the wrong way round, cost 2 kB together (0.7 kB gzipped);
// COLMAP's models of a lens, and poses that are not quite rigid, cost 3.4 kB (2.1 kB). To sort the faces of a hole would cost 1.6 kB.
// Panoramas cost 12 kB (5.1 kB); closer bounds of maps 0.6 kB (0.6 kB); layers that are denoised 1.6 kB (0.6 kB).
// Values above 16 bytes that are copied by one instruction save 11 kB (one copy takes 6 ns, so hot loops copy number by number).
// Objects made by one function of names and values, refusals made into objects at once, and memories of views made by one function save 2.8 kB.
// Talc as the allocator saves 2.4 kB, 2^x by pow 3 kB (the table of exp2), the same alignment everywhere 0.6 kB, cleared messages of the standard library 0.9 kB.
// The messages of refusals cost 0.3 kB, and 0.45 kB in the small one; they save as much of JavaScript, or more.
it("the wasm stays small", () => {
  const bytes = wasmBytes();
  expect(bytes.length).toBeLessThanOrEqual(290_000);
  expect(gzipSync(bytes, { level: 9 }).length).toBeLessThanOrEqual(132_800);
});

// What of the crate it leaves out stands in src/base/build.rs and src/wasm/mod.rs. It has 42,888 bytes.
it("the wasm of the operator alone stays at most 42.9 kB, gzipped", () => {
  expect(gzipSync(liteBytes(), { level: 9 }).length).toBeLessThanOrEqual(42_900);
});
