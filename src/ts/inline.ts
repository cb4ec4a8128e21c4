export * from "./api.js";
export { init } from "./inline/init.js";
