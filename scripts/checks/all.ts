import { groundwork, type Check } from "./check.js";
import { packageCheck, pageCheck, pythonChecks, rustChecks, typescriptChecks } from "./languages.js";
import { packagingChecks, supplyChecks } from "./packaging.js";

/** Every check of `npm test`. They start in this order, and a check comes after the checks that it needs. */
export const checks: Check[] = [
  ...groundwork,
  // The longest checks come first, so that short ones fill the gaps.
  pageCheck,
  packageCheck,
  ...pythonChecks,
  ...rustChecks,
  ...typescriptChecks,
  ...packagingChecks,
  ...supplyChecks,
];
