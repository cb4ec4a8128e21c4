import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, realpathSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const root = join(import.meta.dirname, "../..");

/** The folder of the projects, with the package installed in it. Each test process has its own. */
export const consumers = join(root, "target", "consumers", process.env["VITEST_POOL_ID"] ?? "0");
export const project = (...parts: string[]): string => join(consumers, "projects", ...parts);
const tarball = join(consumers, "hidden-point-removal.tgz");
/** The apps, each with its own `package.json`. */
export const apps = join(import.meta.dirname, "apps");
const QUIET = ["--no-audit", "--no-fund", "--loglevel=error"];
export const installed = join(consumers, "node_modules", "hidden-point-removal");

/**
 * Packs the package and installs the tarball, like a user does. A file that is missing in
 * the tarball is missing here, and no import resolves to the repository's own files.
 */
export function installPacked(): void {
  rmSync(consumers, { recursive: true, force: true });
  mkdirSync(consumers, { recursive: true });
  const name = npm(root, "pack", "--silent", "--pack-destination", consumers).trim();
  renameSync(join(consumers, name), tarball);
  writeFileSync(join(consumers, "package.json"), JSON.stringify({ name: "consumers", private: true, type: "module" }));
  npm(consumers, "install", "--offline", ...QUIET, tarball);
  cpSync(join(import.meta.dirname, "projects"), project(), { recursive: true });
}

/**
 * Copies an app to a folder outside of the repository and installs its tools and the tarball there. No file of the
 * repository is above that folder, so nothing is found by chance.
 */
export function installApp(name: string): string {
  const folder = realpathSync(mkdtempSync(join(tmpdir(), `hpr-${name}-`)));
  cpSync(join(apps, name), folder, { recursive: true });
  cpSync(project("app"), join(folder, "shared"), { recursive: true });
  // Bun comes by an install script.
  npm(folder, "install", "--prefer-offline", "--ignore-scripts=false", ...QUIET, tarball);
  return folder;
}

/** Runs npm and returns its output. If it fails, the error has the output. */
export function npm(cwd: string, ...args: string[]): string {
  return execFileSync("npm", args, { cwd, encoding: "utf8", stdio: "pipe", shell: process.platform === "win32" });
}
