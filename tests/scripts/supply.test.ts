// How license expressions are read.
import { expect, it } from "vitest";

import { isAllowed } from "../../scripts/supply/allowed.js";

const ALLOWED = new Set(["MIT", "Unicode-3.0", "Apache-2.0 WITH LLVM-exception"]);

it.each([
  ["MIT", true],
  ["GPL-3.0", false],
  ["MIT OR GPL-3.0", true],
  ["GPL-3.0 OR MIT", true],
  ["MIT AND GPL-3.0", false],
  ["GPL-3.0 AND MIT", false],
  ["(MIT OR Apache-2.0) AND Unicode-3.0", true],
  ["(GPL-3.0 OR Apache-2.0) AND Unicode-3.0", false],
  ["GPL-3.0 OR MIT AND Unicode-3.0", true],
  ["Apache-2.0 WITH LLVM-exception OR GPL-3.0", true],
  ["Apache-2.0 WITH Other-exception", false],
  ["", false],
  ["(MIT", false],
  ["MIT)", false],
])("%s: %s", (expression, allowed) => {
  expect(isAllowed(expression, ALLOWED)).toBe(allowed);
});
