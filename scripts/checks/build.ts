import { build } from "../build/build.js";
import type { Check } from "./check.js";
import { PASS } from "./check.js";

export const BUILD = "Build: WebAssembly, npm package, demo page";

export const buildCheck: Check = {
  title: BUILD,
  run: async () => {
    await build();
    return PASS;
  },
};
