import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

/** Something of others that is part of what we ship. */
export interface Component {
  name: string;
  version: string;
  /** As its package declares it, an SPDX expression; undefined where it declares none. */
  license: string | undefined;
  /** The text of the license, where the package carries one. */
  text: string | undefined;
}

/** The license text in a package's folder; of several the MIT one, which is the shortest to keep to. */
export function licenseText(folder: string): string | undefined {
  const files = existsSync(folder) ? readdirSync(folder).filter((name) => /^licen[cs]e/i.test(name)) : [];
  const file = files.find((name) => /mit/i.test(name)) ?? files.sort()[0];
  return file === undefined ? undefined : readFileSync(join(folder, file), "utf8").replaceAll("\r\n", "\n").trim();
}
