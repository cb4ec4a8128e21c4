import wasm from "../../src/ts/formats/e57/e57.wasm?url";
import { missingPart } from "./problem.ts";

/** The page itself serves its wasm. */
export async function compileE57(name: string): Promise<WebAssembly.Module> {
  try {
    return await WebAssembly.compile(await (await fetch(wasm)).arrayBuffer());
  } catch {
    throw missingPart(name);
  }
}
