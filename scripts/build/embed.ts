import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

import { build } from "esbuild";

import { inRoot } from "../lib/paths.js";

/** Modules that hold the wasm and the worker's script as text, for the entry `inline`. */
export const EMBEDDED = ["embedded.js", "embedded.d.ts", "embedded-worker.js", "embedded-worker.d.ts"];

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

/**
 * Bundles the worker's script to one file, which works at any address. Writes the modules of `inline` that hold it.
 * Returns the script.
 */
export async function embedWorker(): Promise<Uint8Array> {
  const { outputFiles } = await build({
    entryPoints: [inRoot("src/ts/worker/worker-thread.ts")],
    bundle: true,
    minify: true,
    // One script is a module, a classic script, and text that Node runs.
    format: "iife",
    target: "es2022",
    write: false,
  });
  const [script] = outputFiles;
  const texts = [
    `export const workerText =\n  ${JSON.stringify(script!.text)};\n`,
    "/** worker-thread.js in one file. */\nexport const workerText: string;\n",
  ];
  EMBEDDED.slice(2).forEach((name, i) => {
    writeFileSync(inRoot("src/ts/wasm", name), texts[i] ?? "");
  });
  return script!.contents;
}

/** The script for pages without a bundler: the wasm and the worker's script are in it, and nothing is fetched. */
export async function bundleGlobal(): Promise<Uint8Array> {
  const { outputFiles } = await build({
    entryPoints: [inRoot("src/ts/global.ts")],
    bundle: true,
    minify: true,
    format: "iife",
    globalName: "HiddenPointRemoval",
    target: "es2022",
    // The addresses of files beside the modules, which it does not use.
    define: { "import.meta.url": "document.baseURI" },
    write: false,
  });
  return outputFiles[0]!.contents;
}
