import { buildDemo } from "./demo.js";
import { buildPackage } from "./package.js";
import { buildWasm } from "./wasm.js";

/** The package and the demo page; steps whose inputs did not change are skipped. */
export async function build(): Promise<void> {
  await buildWasm();
  await buildPackage();
  await buildDemo();
}
