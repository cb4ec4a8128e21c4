import { copyFileSync, mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import nodeResolve from "@rollup/plugin-node-resolve";

mkdirSync("built", { recursive: true });
copyFileSync("index.html", "built/index.html");
for (const name of ["hpr.wasm", "worker-thread.js"]) {
  copyFileSync(fileURLToPath(import.meta.resolve(`hidden-point-removal/${name}`)), `built/${name}`);
}
copyFileSync(fileURLToPath(import.meta.resolve("hidden-point-removal/lite/hpr.wasm")), "built/lite.wasm");

export default { input: "main.js", output: { dir: "built" }, plugins: [nodeResolve()] };
