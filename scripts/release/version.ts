import { readFileSync } from "node:fs";
import { join } from "node:path";

interface Packages {
  version: string;
  packages: Record<string, { version?: string }>;
}

/** The version that each file of a repository states. */
export function statedVersions(root: string): Record<string, string | undefined> {
  const text = (file: string) => readFileSync(join(root, file), "utf8");
  const json = (file: string) => JSON.parse(text(file)) as Packages;
  const lock = json("package-lock.json");
  return {
    "Cargo.toml": /^\[package\][^[]*?^version = "([^"]+)"/ms.exec(text("Cargo.toml"))?.[1],
    "Cargo.lock": /^name = "hidden-point-removal"\nversion = "([^"]+)"/m.exec(text("Cargo.lock"))?.[1],
    "package.json": json("package.json").version,
    "package-lock.json": lock.packages[""]?.version === lock.version ? lock.version : undefined,
  };
}
