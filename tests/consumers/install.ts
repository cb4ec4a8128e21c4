import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const root = join(import.meta.dirname, "../..");

/** The folder of the projects, with the package installed in it. Each test process has its own. */
export const consumers = join(root, "target", "consumers", process.env["VITEST_POOL_ID"] ?? "0");
export const project = (...parts: string[]): string => join(consumers, "projects", ...parts);
export const installed = join(consumers, "node_modules", "hidden-point-removal");

/**
 * Packs the package and installs the tarball, like a user does. A file that is missing in
 * the tarball is missing here, and no import resolves to the repository's own files.
 */
export function installPacked(): void {
  rmSync(consumers, { recursive: true, force: true });
  mkdirSync(consumers, { recursive: true });
  const name = npm(root, "pack", "--silent", "--pack-destination", consumers).trim();
  writeFileSync(join(consumers, "package.json"), JSON.stringify({ name: "consumers", private: true, type: "module" }));
  npm(consumers, "install", "--offline", "--no-audit", "--no-fund", "--loglevel=error", `./${name}`);
  cpSync(join(import.meta.dirname, "projects"), project(), { recursive: true });
}

function npm(cwd: string, ...args: string[]): string {
  return execFileSync("npm", args, { cwd, encoding: "utf8", shell: process.platform === "win32" });
}
