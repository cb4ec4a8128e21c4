// Runs a program without imports that is compiled to WebAssembly: `node run.mjs FILE`. A failed assertion traps.
import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]));
process.exitCode = instance.exports.main(0, 0);
