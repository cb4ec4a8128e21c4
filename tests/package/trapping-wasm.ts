import binaryen from "binaryen";
import { wasmBytes } from "./support";

/** The package's wasm, but one of its exported functions traps. */
export function trappingWasm(name: string): Uint8Array<ArrayBuffer> {
  const module = binaryen.readBinary(wasmBytes());
  const { value } = binaryen.getExportInfo(module.getExport(name));
  const { params, results } = binaryen.getFunctionInfo(module.getFunction(value));
  module.removeFunction(value);
  module.addFunction(value, params, results, [], module.unreachable());
  return new Uint8Array(module.emitBinary());
}
