import { buildDemo } from "./demo.js";
import { buildPackage } from "./package.js";
import { buildWasm } from "./wasm.js";

/** Builds the package and the demo page. Steps whose inputs did not change are skipped. */
export async function build(): Promise<void> {
  await buildWasm();
  await buildPackage();
  await buildDemo();
}
