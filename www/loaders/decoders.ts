import { missingPart } from "./problem.ts";
import wasm from "../../src/ts/formats/files.wasm?url";

/** The page itself serves the wasm that reads LAZ and E57. */
export async function compileFiles(name: string): Promise<WebAssembly.Module> {
  try {
    return await WebAssembly.compile(await (await fetch(wasm)).arrayBuffer());
  } catch {
    throw missingPart(name);
  }
}
