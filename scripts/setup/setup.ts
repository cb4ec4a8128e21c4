import { setUpLinker } from "./linker.js";
import { BARE_TARGET, WASM_TARGET, setUpComponents, setUpRust, setUpTarget } from "./rust.js";

/** Installs everything that a build needs and that is missing. */
export async function setUpForBuild(): Promise<void> {
  await setUpRust();
  await setUpLinker();
  await setUpTarget(WASM_TARGET);
}

/** Installs what the Rust checks need besides that. (The page's tests set up the browser.) */
export async function setUpForChecks(): Promise<void> {
  await setUpForBuild();
  await setUpTarget(BARE_TARGET);
  await setUpComponents();
}
