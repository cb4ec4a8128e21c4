import { build } from "../build/build.js";
import { setUpForChecks } from "../setup/setup.js";
import { setUpWasmPack } from "../setup/wasm-pack.js";
import type { Check } from "./check.js";
import { PASS } from "./check.js";

export const SETUP = "Set-up: Rust";
export const WASM_PACK = "Set-up: wasm-pack";
export const BUILD = "Build: WebAssembly, npm package, demo page";

/** Checks that belong to no part. Other checks need them. */
export const groundwork: Check[] = [
  step(SETUP, setUpForChecks),
  step(WASM_PACK, setUpWasmPack, { needs: [SETUP] }),
  step(BUILD, build, { needs: [WASM_PACK], locks: "wasm" }),
];

function step(title: string, work: () => Promise<void>, more: Partial<Check> = {}): Check {
  const run = async () => {
    await work();
    return PASS;
  };
  return { title, part: undefined, run, ...more };
}
