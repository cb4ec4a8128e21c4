import { spawnSync } from "node:child_process";

import type { Answered, Consumer } from "./consumer";
import { project } from "./install";

/** Scripts under Node. */
export const nodeScripts: Consumer[] = [
  script("Node, import", "esm.mjs"),
  script("Node, ./inline", "inline.mjs"),
  { ...script("Node, require of an ES module", "required.cjs"), ...(canRequire() ? {} : { lacking: "this Node cannot require ES modules" }) },
  script("a server that renders pages", "server-side.mjs"),
];

function script(name: string, file: string): Consumer {
  return {
    name,
    version: process.version,
    run: () => {
      const { stdout, stderr, status } = spawnSync(process.execPath, ["--no-warnings", project("node", file)], { encoding: "utf8" });
      if (status !== 0) throw new Error(stderr);
      return Promise.resolve(JSON.parse(stdout) as Answered);
    },
  };
}

function canRequire(): boolean {
  return (process.features as { require_module?: boolean }).require_module === true;
}
