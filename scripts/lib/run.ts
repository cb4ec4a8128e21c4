import { spawn } from "node:child_process";
import type { SpawnOptions } from "node:child_process";

import { print } from "./output.js";
import { environment, root } from "./paths.js";

export interface RunResult {
  ok: boolean;
  /** Standard output and standard error together, in the order in which they came. */
  output: string;
}

interface RunOptions {
  env?: Record<string, string>;
  /**
   * Where the output is shown during the run. Progress (the default) goes to
   * standard error, so that standard output holds only results.
   */
  show?: "progress" | "results" | "nothing";
}

/** Runs a command in the repository's root and waits for it. Never throws. */
export function run(command: string, args: string[], options: RunOptions = {}): Promise<RunResult> {
  const show = options.show ?? "progress";
  const screen = ({ progress: "stderr", results: "stdout", nothing: undefined } as const)[show];
  // A command that writes to a pipe prints colors only if these variables ask for them.
  const color = screen !== undefined && process[screen].isTTY ? { CARGO_TERM_COLOR: "always", FORCE_COLOR: "1" } : {};
  const settings: SpawnOptions = {
    cwd: root,
    env: environment({ ...color, ...options.env }),
    stdio: ["ignore", "pipe", "pipe"],
    shell: process.platform === "win32",
  };
  return new Promise((resolve) => {
    const child = spawn(command, args, settings);
    let output = "";
    const take = (chunk: Buffer): void => {
      output += chunk.toString();
      if (screen !== undefined) print(chunk, screen);
    };
    child.stdout?.on("data", take);
    child.stderr?.on("data", take);
    child.on("error", (error) => {
      resolve({ ok: false, output: output + error.message });
    });
    child.on("close", (code) => {
      resolve({ ok: code === 0, output });
    });
  });
}

/** Runs a command without showing its output. True if it succeeded. */
export async function succeeds(command: string, ...args: string[]): Promise<boolean> {
  return (await run(command, args, { show: "nothing" })).ok;
}

/** Runs a command. If it fails, stops everything with a plain message. */
export async function mustRun(
  command: string,
  args: string[],
  whatFailed: string,
  options: RunOptions = {},
): Promise<void> {
  const result = await run(command, args, options);
  if (!result.ok) throw new Problem(`${whatFailed} (the messages above say why).`);
}

/** Prints the current step to standard error, where the progress of the commands goes, too. */
export function say(message: string): void {
  print(`${message}\n`, "stderr");
}

/** A problem that the user can solve. It is shown without a stack trace. */
export class Problem extends Error {}
