import { dirname } from "node:path";

import { inRoot } from "../lib/paths.js";
import { Problem, run } from "../lib/run.js";
import { WASM_TARGET } from "../setup/rust.js";
import type { Component } from "./component.js";
import { licenseText } from "./component.js";

interface Metadata {
  packages: CratePackage[];
  resolve: { root: string; nodes: { id: string; deps: { pkg: string; dep_kinds: { kind: string | null }[] }[] }[] };
}

interface CratePackage {
  id: string;
  name: string;
  version: string;
  license: string | null;
  /** Null for a crate of this repository. */
  source: string | null;
  manifest_path: string;
  targets: { kind: string[] }[];
}

/** The crates from which the modules are compiled. Programs that only run during the compilation do not count. */
export async function cratesOfWasm(): Promise<Component[]> {
  const found = [...(await cratesOf("src/cdylib/Cargo.toml")), ...(await cratesOf("src/files/Cargo.toml"))];
  return [...new Map(found.map((crate) => [crate.name, crate])).values()];
}

async function cratesOf(manifest: string): Promise<Component[]> {
  const { packages, resolve } = await metadata(manifest);
  const byId = new Map(packages.map((one) => [one.id, one]));
  const depsOf = new Map(resolve.nodes.map(({ id, deps }) => [id, deps]));
  const found = new Set<string>();
  const visit = (id: string): void => {
    if (found.has(id) || byId.get(id)?.targets.some(({ kind }) => kind.includes("proc-macro"))) return;
    found.add(id);
    for (const { pkg, dep_kinds } of depsOf.get(id) ?? []) {
      if (dep_kinds.some(({ kind }) => kind === null)) visit(pkg);
    }
  };
  visit(resolve.root);
  return packages
    .filter(({ id, source }) => found.has(id) && source !== null)
    .map(({ name, version, license, manifest_path }) => ({
      name,
      version,
      license: license ?? undefined,
      text: licenseText(dirname(manifest_path)),
    }));
}

async function metadata(manifest: string): Promise<Metadata> {
  const where = ["--manifest-path", inRoot(manifest), "--filter-platform", WASM_TARGET];
  const args = ["metadata", "--format-version", "1", "--locked", ...where];
  const { ok, output } = await run("cargo", args, { show: "nothing" });
  const json = output.split("\n").find((line) => line.startsWith("{"));
  if (!ok || json === undefined) throw new Problem(`cargo metadata failed: ${output}`);
  return JSON.parse(json) as Metadata;
}
