import { AsyncLocalStorage } from "node:async_hooks";
import { spawn, type SpawnOptions } from "node:child_process";
import { existsSync } from "node:fs";
import { homedir } from "node:os";
import { delimiter, join } from "node:path";

/** The root of the repository. This file runs as target/scripts/lib/run.js. */
export const root = join(import.meta.dirname, "..", "..", "..");

/** A path inside the repository. */
export function inRoot(...parts: string[]): string {
  return join(root, ...parts);
}

/** TypeScript's native compiler. Only typedoc needs the other one, for its interface. */
export const TSC = inRoot("node_modules/typescript-native/bin/tsc");

/**
 * The environment of every command. On the PATH, the tools of this project come first. rustup's directory comes last,
 * for shells that were opened before rustup was installed.
 */
export function environment(extra: Record<string, string> = {}): NodeJS.ProcessEnv {
  const cargoBin = join(process.env["CARGO_HOME"] ?? join(homedir(), ".cargo"), "bin");
  const path = [inRoot("target/tools/bin"), inRoot("node_modules/.bin"), process.env["PATH"] ?? "", cargoBin];
  return { ...process.env, ...extra, PATH: path.join(delimiter) };
}

/** The full path of a command, or undefined if it is not on the PATH. */
export function findOnPath(command: string): string | undefined {
  const suffixes = process.platform === "win32" ? [".exe", ".cmd"] : [""];
  return (environment()["PATH"] ?? "")
    .split(delimiter)
    .flatMap((directory) => suffixes.map((suffix) => join(directory, command + suffix)))
    .find((file) => existsSync(file));
}

const collector = new AsyncLocalStorage<string[]>();

/** Shows text. Inside `collected`, keeps it instead. */
export function print(text: string | Buffer, stream: "stdout" | "stderr" = "stdout"): void {
  const parts = collector.getStore();
  if (parts === undefined) process[stream].write(text);
  else parts.push(text.toString());
}

/** Runs an action and collects its output in one piece, because other actions print at the same time. */
export async function collected<T>(action: () => Promise<T>): Promise<{ value: T; output: string }> {
  const parts: string[] = [];
  const value = await collector.run(parts, action);
  return { value, output: parts.join("") };
}

interface RunResult {
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
