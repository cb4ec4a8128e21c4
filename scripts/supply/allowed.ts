import { readFileSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import type { Component } from "./component.js";

/** The components whose license is not allowed by the list in deny.toml. */
export function notAllowed(components: Component[]): string[] {
  const allowed = allowedLicenses();
  return components
    .filter(({ license }) => license === undefined || !isAllowed(license, allowed))
    .map(({ name, version, license = "no license" }) => `${name} ${version}: ${license}`);
}

function allowedLicenses(): Set<string> {
  const [, list = ""] = /^allow = \[([^\]]*)\]/m.exec(readFileSync(inRoot("deny.toml"), "utf8")) ?? [];
  return new Set([...list.matchAll(/"([^"]+)"/g)].map(([, name]) => name!));
}

/** Reads expressions such as `A OR B` and `(A OR B) AND C`. `AND` binds more tightly than `OR`. */
export function isAllowed(expression: string, allowed: ReadonlySet<string>): boolean {
  const tokens = expression.match(/[()]|[^\s()]+(?: WITH [^\s()]+)?/g) ?? [];
  let at = 0;
  const either = (): boolean => {
    let value = both();
    while (tokens[at] === "OR") {
      at++;
      // Both sides must be read, whatever the value of the first one.
      value = both() || value;
    }
    return value;
  };
  const both = (): boolean => {
    let value = one();
    while (tokens[at] === "AND") {
      at++;
      value = one() && value;
    }
    return value;
  };
  const one = (): boolean => {
    const token = tokens[at++];
    if (token !== "(") return token !== undefined && allowed.has(token);
    const value = either();
    return tokens[at++] === ")" && value;
  };
  return either() && at >= tokens.length;
}
