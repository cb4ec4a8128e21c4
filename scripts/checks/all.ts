import { groundwork } from "./build.js";
import type { Check } from "./check.js";
import { packagingChecks } from "./packaging.js";
import { pythonCheck } from "./python.js";
import { rustChecks } from "./rust.js";
import { supplyChecks } from "./supply.js";
import { packageCheck, pageCheck, typescriptChecks } from "./typescript.js";

/** Every check of `npm test`. They start in this order, and a check comes after the checks that it needs. */
export const checks: Check[] = [
  ...groundwork,
  // The longest checks come first, so that short ones fill the gaps.
  pageCheck,
  packageCheck,
  pythonCheck,
  ...rustChecks,
  ...typescriptChecks,
  ...packagingChecks,
  ...supplyChecks,
];
