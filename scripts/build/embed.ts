import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

import { inRoot } from "../lib/paths.js";

/** A module that holds the wasm as text, for the entry `inline`. */
export const EMBEDDED = ["embedded.js", "embedded.d.ts"];

/** Writes these files beside the wasm. */
export function embedWasm(): void {
  const gzipped = gzipSync(readFileSync(inRoot("src/ts/wasm/hpr_bg.wasm")), { level: 9 });
  const texts = [
    `export const gzippedWasm =\n  "${gzipped.toString("base64")}";\n`,
    "/** hpr_bg.wasm, gzipped, in base64. */\nexport const gzippedWasm: string;\n",
  ];
  EMBEDDED.forEach((name, i) => {
    writeFileSync(inRoot("src/ts/wasm", name), texts[i] ?? "");
  });
}
