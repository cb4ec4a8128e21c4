import { execFileSync, spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";

import type { Answered, Consumer } from "./consumer";
import { project } from "./install";
import { points, viewpoint } from "./question";

/** Scripts without a page. */
export const nodeScripts: Consumer[] = [
  script("Node, import", "esm.mjs"),
  script("Node, ./inline", "inline.mjs"),
  script("Node, ./lite", "lite.mjs"),
  {
    ...script("Node, require of an ES module", "required.cjs"),
    ...(canRequire() ? {} : { lacking: "this Node cannot require ES modules" }),
  },
  script("a server that renders pages", "server-side.mjs"),
  {
    name: "npx hidden-point-removal",
    version: process.version,
    run: () => {
      // Each line holds a position and the number of the line.
      const lines = Array.from({ length: points.length / 3 }, (_, i) =>
        [...points.subarray(3 * i, 3 * i + 3), i].join(" "),
      );
      writeFileSync(project("cloud.xyz"), `${lines.join("\n")}\n`);
      const args = [
        "--offline",
        "hidden-point-removal",
        "cloud.xyz",
        "--from",
        viewpoint.join(","),
        "--looks",
        "0",
        "-o",
        "-",
      ];
      const printed = execFileSync("npx", args, {
        cwd: project(),
        encoding: "utf8",
        stdio: "pipe",
        shell: process.platform === "win32",
      });
      const visible = printed
        .trim()
        .split("\n")
        .map((line) => Number(line.split(" ")[3]));
      return Promise.resolve({ here: visible, there: visible });
    },
  },
];

function script(name: string, file: string): Consumer {
  return {
    name,
    version: process.version,
    run: () => {
      const { stdout, stderr, status } = spawnSync(process.execPath, ["--no-warnings", project("node", file)], {
        encoding: "utf8",
      });
      if (status !== 0) throw new Error(stderr);
      return Promise.resolve(JSON.parse(stdout) as Answered);
    },
  };
}

function canRequire(): boolean {
  return (process.features as { require_module?: boolean }).require_module === true;
}
