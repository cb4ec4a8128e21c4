export * from "./api.js";
export { init } from "./loader.js";
