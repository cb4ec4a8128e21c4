// What the script for pages without a bundler offers, as `HiddenPointRemoval`. It is one file.
import { useEmbedded } from "./inline/init.js";

export * from "./inline.js";
export { WorkerPointCloud } from "./worker.js";
export { PotreeFilter } from "./potree.js";

useEmbedded();
