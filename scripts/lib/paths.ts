import { existsSync } from "node:fs";
import { homedir } from "node:os";
import { delimiter, join } from "node:path";

/** The root of the repository. This file runs as target/scripts/lib/paths.js. */
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
