import { existsSync } from "node:fs";
import { dirname, join } from "node:path";

/** The repository. Some of this runs where it is, and some compiled, deep in target/. */
export const root = above(import.meta.dirname);

function above(directory: string): string {
  return existsSync(join(directory, "package.json")) ? directory : above(dirname(directory));
}
