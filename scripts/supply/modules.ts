import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

import { inRoot, root } from "../lib/paths.js";
import type { Component } from "./component.js";
import { licenseText } from "./component.js";

interface Manifest {
  name: string;
  version: string;
  license?: string;
  dependencies?: Record<string, string>;
}

/** Files that run while the page is built, or that are not sources of the page. */
const NOT_OF_THE_PAGE = /^(build|dist|public)\/|vite\.config\.ts$/;

/**
 * The npm packages that the demo page may contain: the packages that its sources import, and all
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
  const www = inRoot("www");
  const sources = readdirSync(www, { recursive: true, encoding: "utf8" }).filter(
    (path) => path.endsWith(".ts") && !NOT_OF_THE_PAGE.test(path),
  );
  const names = sources.flatMap((path) => {
    const text = readFileSync(join(www, path), "utf8");
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
