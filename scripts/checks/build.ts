import { build } from "../build/build.js";
import { Problem } from "../lib/run.js";
import type { Check } from "./check.js";
import { FAIL, PASS } from "./check.js";

export const BUILD = "Build: WebAssembly, npm package, demo page";

export const buildCheck: Check = {
  title: BUILD,
  run: async () => {
    try {
      await build();
      return PASS;
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      console.log(error.message);
      return FAIL;
    }
  },
};
