import { execFileSync, spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";

import type { Answered, Consumer } from "./consumer";
import { project } from "./install";
import { points, viewpoint } from "./question";

/** Scripts without a page. */
export const nodeScripts: Consumer[] = [
  script("Node, import", "esm.mjs"),
  script("Node, ./inline", "inline.mjs"),
  {
    ...script("Node, require of an ES module", "required.cjs"),
    ...(canRequire() ? {} : { lacking: "this Node cannot require ES modules" }),
  },
  script("a server that renders pages", "server-side.mjs"),
  { ...elsewhere("Deno", ["deno", "run", "--allow-all", "--node-modules-dir=manual"]), further: true },
  { ...elsewhere("Bun", ["bun"]), further: true },
  {
    name: "npx hidden-point-removal",
    version: process.version,
    run: () => {
      // Each line holds a position and the number of the line.
      const lines = Array.from({ length: points.length / 3 }, (_, i) =>
        [...points.subarray(3 * i, 3 * i + 3), i].join(" "),
      );
      writeFileSync(project("cloud.xyz"), `${lines.join("\n")}\n`);
      const args = ["--offline", "hidden-point-removal", "cloud.xyz", "--from", viewpoint.join(","), "-o", "-"];
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

function script(
  name: string,
  file: string,
  command = [process.execPath, "--no-warnings"],
  version = process.version,
): Consumer {
  return {
    name,
    version,
    run: () => {
      const [program = "", ...args] = command;
      const { stdout, stderr, status } = spawnSync(program, [...args, project("node", file)], { encoding: "utf8" });
      if (status !== 0) throw new Error(stderr);
      return Promise.resolve(JSON.parse(stdout) as Answered);
    },
  };
}

/** The same script in another runtime, if it is installed. */
function elsewhere(name: string, command: string[]): Consumer {
  const { stdout, status } = spawnSync(command[0]!, ["--version"], {
    encoding: "utf8",
    shell: process.platform === "win32",
  });
  if (status !== 0)
    return { ...script(name, "esm.mjs", command, ""), lacking: `there is no ${command[0]!} on the PATH` };
  return script(name, "esm.mjs", command, /\d+\.\d+\.\d+/.exec(stdout)?.[0]);
}

function canRequire(): boolean {
  return (process.features as { require_module?: boolean }).require_module === true;
}
