import { Problem } from "../lib/run.js";

/** The parts of `npm test`. Each can be run alone; `npm test -- core page` runs two. */
export const PARTS = {
  core: "the Rust crate: native tests, tests in WebAssembly, no_std",
  package: "the npm package under Node",
  page: "the demo page and the adapters that draw, in Chromium",
  python: "the Python package",
  types: "the TypeScript of package, page, tests and scripts",
  lint: "clippy and oxlint",
  format: "rustfmt and oxfmt",
  docs: "rustdoc and typedoc",
  packaging: "the crate and the npm package as they would be published, and users' projects",
  supply: "licenses and sources of everything that is built in",
  scripts: "the commands themselves",
} as const;

export type Part = keyof typeof PARTS;

/** The parts that the arguments name, or all parts if there are no arguments. */
export function chosenParts(names: string[]): Set<Part> {
  const all = Object.keys(PARTS) as Part[];
  const unknown = names.find((name) => !Object.hasOwn(PARTS, name));
  if (unknown !== undefined) {
    const list = all.map((part) => `  ${part.padEnd(10)} ${PARTS[part]}`);
    throw new Problem(`npm test has no part "${unknown}". Its parts are:\n${list.join("\n")}`);
  }
  return new Set(names.length === 0 ? all : (names as Part[]));
}
