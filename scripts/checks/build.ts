import { build } from "../build/build.js";
import { setUpForChecks } from "../setup/setup.js";
import type { Check } from "./check.js";
import { PASS } from "./check.js";

export const SETUP = "Set-up: Rust";
export const BUILD = "Build: WebAssembly, npm package, demo page";

/** Checks that belong to no part. Other checks need them. */
export const groundwork: Check[] = [
  {
    title: SETUP,
    part: undefined,
    run: async () => {
      await setUpForChecks();
      return PASS;
    },
  },
  {
    title: BUILD,
    part: undefined,
    needs: [SETUP],
    locks: "wasm",
    run: async () => {
      await build();
      return PASS;
    },
  },
];
