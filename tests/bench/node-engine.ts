// The package in a process of its own: node-engine.js WASM CLOUD < TASKS, both JSON.
import { readFileSync } from "node:fs";

import { measure, type Task } from "./measure.js";
import { readCloud } from "./paths.js";

const [wasm, file] = process.argv.slice(2);
const tasks = JSON.parse(readFileSync(0, "utf8")) as Task[];
console.log(JSON.stringify(await measure(wasm!, readCloud(file!), tasks)));
