import { dirname, join } from "node:path";
import { existsSync, readFileSync, readdirSync } from "node:fs";

import { Problem, inRoot, root, run } from "../lib/run.js";
import { WASM_TARGET } from "../setup/rust.js";

/** Work of others that is part of the published packages or the page. */
export interface Component {
  name: string;
  version: string;
  /** The SPDX expression that its package declares, or undefined. */
  license: string | undefined;
  /** The text of the license, if the package contains it. */
  text: string | undefined;
}

/** The license text in a package's folder. If there are several, the MIT license, whose terms are the shortest. */
function licenseText(folder: string): string | undefined {
  const files = existsSync(folder) ? readdirSync(folder).filter((name) => /^licen[cs]e/i.test(name)) : [];
  const file = files.find((name) => /mit/i.test(name)) ?? files.sort()[0];
  return file === undefined ? undefined : readFileSync(join(folder, file), "utf8").replaceAll("\r\n", "\n").trim();
}

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

interface Manifest {
  name: string;
  version: string;
  license?: string;
  dependencies?: Record<string, string>;
}

/** Files that run while the page is built, or that are not sources of the page. */
const NOT_OF_THE_PAGE = /^(build|dist|public)\/|vite\.config\.ts$/;

/**
 * The npm packages that the demo page and its examples may contain: the packages that their sources import, and all
 * their dependencies. (The list may be too long, because a bundler leaves some out.)
 */
export function modulesOfPage(): Component[] {
  const found = new Map<string, Component>();
  const visit = (name: string): void => {
    if (found.has(name) || name === ownName()) return;
    const folder = inRoot("node_modules", name);
    const { version, license, dependencies = {} } = manifestIn(folder);
    found.set(name, { name, version, license, text: licenseText(folder) ?? publishedText(name) });
    Object.keys(dependencies).forEach(visit);
  };
  importedByPage().forEach(visit);
  return [...found.values()];
}

/** The texts of licenses that packages name and do not hold, from their repositories. */
const PUBLISHED: Record<string, string> = { "laz-perf": "LICENSE-APACHE", tr46: "scripts/supply/tr46-license.txt" };

function publishedText(name: string): string | undefined {
  const file = PUBLISHED[name];
  return file === undefined ? undefined : readFileSync(inRoot(file), "utf8").trim();
}

function importedByPage(): string[] {
  const filesOf = (folder: string, isOne: (path: string) => boolean) =>
    readdirSync(inRoot(folder), { recursive: true, encoding: "utf8" })
      .filter(isOne)
      .map((path) => inRoot(folder, path));
  const sources = [
    ...filesOf("www", (path) => path.endsWith(".ts") && !NOT_OF_THE_PAGE.test(path)),
    ...filesOf("examples", (path) => path.endsWith(".html")),
  ];
  const names = sources.flatMap((path) => {
    const text = readFileSync(path, "utf8");
    return [...text.matchAll(/(?:from |import |import\()"((?:@[^/"]+\/)?[^./"@:][^/":]*)(?:\/[^"]*)?"/g)].map(
      ([, name]) => name!,
    );
  });
  return [...new Set(names)].sort();
}

function ownName(): string {
  return manifestIn(root).name;
}

function manifestIn(folder: string): Manifest {
  return JSON.parse(readFileSync(join(folder, "package.json"), "utf8")) as Manifest;
}
