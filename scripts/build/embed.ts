import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

import { build, type BuildOptions } from "esbuild";

import { inRoot } from "../lib/paths.js";

/** Modules that hold the wasm and the worker's script as text, for the entry `inline`. */
export const EMBEDDED = ["embedded.js", "embedded.d.ts", "embedded-worker.js", "embedded-worker.d.ts"];

/** Writes these files beside the wasm. */
export function embedWasm(): void {
  const gzipped = gzipSync(readFileSync(inRoot("src/ts/wasm/hpr_bg.wasm")), { level: 9 });
  write(EMBEDDED.slice(0, 2), [
    `export const gzippedWasm =\n  "${gzipped.toString("base64")}";\n`,
    "/** hpr_bg.wasm, gzipped, in base64. */\nexport const gzippedWasm: string;\n",
  ]);
}

/** Bundles the worker's script, and writes the modules of `inline` that hold it. Returns the script. */
export async function embedWorker(): Promise<Uint8Array> {
  // One script is a module, a classic script, and text that Node runs.
  const script = await bundle("worker/worker-thread.ts");
  write(EMBEDDED.slice(2), [
    `export const workerText =\n  ${JSON.stringify(Buffer.from(script).toString())};\n`,
    "/** worker-thread.js in one file. */\nexport const workerText: string;\n",
  ]);
  return script;
}

/** The script for pages without a bundler: the wasm and the worker's script are in it, and nothing is fetched. */
export function bundleGlobal(): Promise<Uint8Array> {
  return bundle("global.ts", {
    globalName: "HiddenPointRemoval",
    // The addresses of files beside the modules, which it does not use.
    define: { "import.meta.url": "document.baseURI" },
  });
}

/** A file of src/ts and all that it imports, as one script that works at any address. */
async function bundle(entry: string, options: BuildOptions = {}): Promise<Uint8Array> {
  const entryPoints = [inRoot("src/ts", entry)];
  const usual = { bundle: true, minify: true, format: "iife", target: "es2022" } as const;
  const { outputFiles } = await build({ entryPoints, ...usual, ...options, write: false });
  return outputFiles[0]!.contents;
}

function write(names: string[], texts: string[]): void {
  names.forEach((name, i) => {
    writeFileSync(inRoot("src/ts/wasm", name), texts[i]!);
  });
}
