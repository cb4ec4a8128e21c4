import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

import { inRoot } from "../lib/paths.js";

/** The wasm as a module of text, for the entry that carries it along. */
export const EMBEDDED = ["embedded.js", "embedded.d.ts"];

/** Writes those files beside the wasm they are made of. */
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
