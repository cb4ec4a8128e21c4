import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

import { inRoot } from "../lib/paths.js";
import type { Component } from "./component.js";

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
