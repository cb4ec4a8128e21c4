import { type Binary, compile, compiledOnce, compileOwn, type InitInput } from "../instance/compile.js";
import type { CompileFiles } from "../formats/wasm.js";

const binary: Binary = {
  file: "files.wasm",
  wayOut:
    "Serve files.wasm (the package exports it as hidden-point-removal/files.wasm) and pass its address or its bytes as " +
    "the option wasm (docs/FILES.md)",
};

/** Compiles the wasm that reads E57 and LAZ. The address is one literal expression, which bundlers look for, and begins in dist. */
export const compileFiles: CompileFiles = compiledOnce(() =>
  compileOwn(() => new URL("./formats/files.wasm", import.meta.url), binary),
);

/** The wasm of an option, if it is given. */
export function compiler(given: unknown): CompileFiles {
  return given === undefined ? compileFiles : compiledOnce(() => compile(given as InitInput, binary));
}
