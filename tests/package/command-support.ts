// Runs the command in a folder of its own.
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import type * as Command from "../../src/ts/cli/command";

const root = join(import.meta.dirname, "../..");
export const COMMAND = join(root, "dist/cli.js");
const { command } = (await import(pathToFileURL(join(root, "dist/command.js")).href)) as typeof Command;

export function commandIn(folder: string) {
  const scratch = join(root, "target", folder);
  rmSync(scratch, { recursive: true, force: true });
  mkdirSync(scratch, { recursive: true });
  const place = (name: string) => join(scratch, name);
  return {
    place,
    write: (name: string, content: Uint8Array | string) => {
      writeFileSync(place(name), content);
    },
    read: (name: string) => readFileSync(place(name)),
    lines: (name: string) => readFileSync(place(name), "utf8").split("\n").slice(0, -1),
    /** Runs it in this process: a new one takes longer than most questions. */
    run: async (...args: string[]) => {
      const before = process.cwd();
      process.chdir(scratch);
      let stderr = "";
      const status = await command(args, { write: (text) => (stderr += text) });
      process.chdir(before);
      return { stderr, status };
    },
    /** Runs it as npx runs it. */
    spawned: (...args: string[]) => {
      const { stdout, stderr, status } = spawnSync(process.execPath, [COMMAND, ...args], {
        cwd: scratch,
        // A command that waits for ever fails; the test does not hang.
        timeout: 60_000,
      });
      return { stdout, stderr: stderr.toString(), status };
    },
  };
}

/** The data of a NumPy file, and its header. */
export function numpy(file: Buffer): { header: string; data: Buffer } {
  const start = 10 + file.readUInt16LE(8);
  return { header: file.toString("latin1", 10, start).trim(), data: file.subarray(start) };
}
