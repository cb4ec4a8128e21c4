import { existsSync } from "node:fs";
import { dirname, join } from "node:path";

/** The folder of the repository. Some test files run in place. Others are compiled and run deep in target/. */
export const root = above(import.meta.dirname);

function above(directory: string): string {
  return existsSync(join(directory, "package.json")) ? directory : above(dirname(directory));
}
