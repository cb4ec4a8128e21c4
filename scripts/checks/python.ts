import { existsSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import type { Check } from "./check.js";
import { FAIL } from "./check.js";
import { print } from "../lib/output.js";

export const pythonCheck: Check = {
  title: "Python package",
  part: "python",
  run: () => {
    if (!existsSync(inRoot("python"))) {
      return Promise.resolve({ passed: 0, failed: 0, skipped: "there is no Python package yet (no folder python/)" });
    }
    print("There is a folder python/, but scripts/checks/python.ts runs nothing in it yet.\n");
    return Promise.resolve(FAIL);
  },
};
