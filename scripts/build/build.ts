import { buildDemo } from "./demo.js";
import { buildE57 } from "./e57.js";
import { buildPackage } from "./package.js";
import { buildWasm } from "./wasm.js";

/** Builds the package and the demo page. Steps whose inputs did not change are skipped. */
export async function build(): Promise<void> {
  await buildWasm();
  await buildE57();
  await buildPackage();
  await buildDemo();
}
