import { launchBrowser } from "./site.js";

/** One browser for all test files of a worker of vitest. It has WebGPU in software. It ends with the worker. */
export const browser = await launchBrowser("--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader");
