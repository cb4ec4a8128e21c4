import { readFileSync } from "node:fs";

import { inRoot } from "../lib/paths.js";

const CRATES_IO = "registry+https://github.com/rust-lang/crates.io-index";
const OWN = new Set(["hidden-point-removal", "hpr", "hpr-files", "hpr-tests", "dependent"]);
const NPM = "https://registry.npmjs.org/";

/** The entries of the lock files that have no checksum or do not come from the two registries. */
export function notLocked(): string[] {
  return [...crates("Cargo.lock"), ...packages()];
}

function crates(file: string): string[] {
  const [, ...entries] = readFileSync(inRoot(file), "utf8").split("[[package]]\n");
  const field = (entry: string, name: string) => new RegExp(`^${name} = "([^"]*)"`, "m").exec(entry)?.[1];
  return (
    entries
      .map((entry) => ({ name: field(entry, "name")!, source: field(entry, "source"), sum: field(entry, "checksum") }))
      // The project's own crates have no source.
      .filter(({ name, source, sum }) => !OWN.has(name) && !(source === CRATES_IO && sum))
      .map(({ name, source = "no source" }) => `${file}: ${name} (${source})`)
  );
}

function packages(): string[] {
  const lock = JSON.parse(readFileSync(inRoot("package-lock.json"), "utf8")) as {
    packages: Record<string, { resolved?: string; integrity?: string; link?: boolean; inBundle?: boolean }>;
  };
  return Object.entries(lock.packages)
    .filter(([path, { resolved = NPM, integrity, inBundle }]) => {
      // A package inside the archive of another package shares its checksum.
      return path !== "" && inBundle !== true && !(resolved.startsWith(NPM) && integrity !== undefined);
    })
    .map(([path, { resolved = "no checksum" }]) => `package-lock.json: ${path} (${resolved})`);
}
