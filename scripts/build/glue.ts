import { readFileSync, writeFileSync } from "node:fs";

import { Problem } from "../lib/run.js";

/** What wasm-bindgen writes, and what stands there instead. */
const CHANGES = [
  [
    "let cachedTextDecoder = new TextDecoder('utf-8', { ignoreBOM: true });\ncachedTextDecoder.decode();\n",
    `let cachedTextDecoder;
function newTextDecoder() {
    // The wasm's own texts are ASCII.
    return typeof TextDecoder === 'undefined'
        ? { decode: (bytes) => String.fromCharCode(...bytes) }
        : new TextDecoder('utf-8', { ignoreBOM: true });
}
`,
  ],
  [
    "        cachedTextDecoder = new TextDecoder('utf-8', { ignoreBOM: true });\n        cachedTextDecoder.decode();\n",
    "        cachedTextDecoder = undefined;\n",
  ],
  ["    return cachedTextDecoder.decode(bytes);", "    return (cachedTextDecoder ??= newTextDecoder()).decode(bytes);"],
] as const;

/**
 * The generated glue makes a TextDecoder when it is imported. jsdom, in which Jest runs tests of pages, has none:
 * the import would fail.
 */
export function easeGlue(file: string): void {
  let glue = readFileSync(file, "utf8");
  for (const [generated, own] of CHANGES) {
    if (!glue.includes(generated)) {
      throw new Problem(`${file} differs from what scripts/build/glue.ts expects. It lacks:\n${generated}`);
    }
    glue = glue.replace(generated, () => own);
  }
  writeFileSync(file, glue);
}

/**
 * Numbers the functions that the module imports, where wasm-bindgen put a hash of 16 digits into each name. Hashes do not
 * compress: they take 0.4 kB of the gzipped module, and as much of each entry that holds the glue.
 */
export function numberImports(files: readonly string[], glue: string): void {
  const hashes = new Set(
    [...readFileSync(glue, "utf8").matchAll(/__wbg_\w+_([0-9a-f]{16})\b/g)].map(([, hash]) => hash!),
  );
  const numbers = new Map([...hashes].map((hash, number) => [hash, String(number).padStart(hash.length, "0")]));
  for (const file of files) {
    const text = readFileSync(file, "latin1");
    writeFileSync(
      file,
      text.replace(/(?<=_)[0-9a-f]{16}(?![0-9a-f])/g, (hash) => numbers.get(hash) ?? hash),
      "latin1",
    );
  }
}
