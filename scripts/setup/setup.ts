import { setUpLinker } from "./linker.js";
import { BARE_TARGET, WASM_TARGET, setUpComponents, setUpRust, setUpTarget } from "./rust.js";
import { setUpWasmTools } from "./tools.js";

/** Everything a build needs; what is there already is left alone. */
export async function setUpForBuild(): Promise<void> {
  await setUpRust();
  await setUpLinker();
  await setUpTarget(WASM_TARGET);
  await setUpWasmTools();
}

/** Everything the Rust checks need besides the tools of a build (the browser is set up by the tests that open it). */
export async function setUpForChecks(): Promise<void> {
  await setUpRust();
  await setUpLinker();
  await setUpTarget(WASM_TARGET);
  await setUpTarget(BARE_TARGET);
  await setUpComponents();
}
