import { readFileSync, writeFileSync } from "node:fs";

import { mustRun } from "../lib/run.js";
import { withoutMessages } from "./panics.js";

const OPTIONS = [
  "-Oz",
  // Nothing is at the lowest 1024 addresses but the far end of the stack, so offsets may be folded into loads and stores.
  "--low-memory-unused",
  "--converge",
  // A large function with one caller stays a function: in a huge function, the numbers of variables take two bytes.
  "--one-caller-inline-max-function-size=40",
  // Functions of one file stand together. They are alike, so gzip finds more to repeat: 1 kB.
  "--reorder-functions-by-name",
  // Engines ignore the alignment of loads and stores. Where it is always the same, gzip saves 0.6 kB.
  "--dealign",
  "--strip-producers",
  "--strip-target-features",
];

/** Shrinks a module as wasm-bindgen made it, in place. It must have names, and loses them. */
export async function optimize(module: string, failed: string): Promise<void> {
  writeFileSync(module, withoutMessages(readFileSync(module)));
  await mustRun("wasm-opt", [...OPTIONS, module, "-o", module], failed);
}
