import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

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
export function licenseText(folder: string): string | undefined {
  const files = existsSync(folder) ? readdirSync(folder).filter((name) => /^licen[cs]e/i.test(name)) : [];
  const file = files.find((name) => /mit/i.test(name)) ?? files.sort()[0];
  return file === undefined ? undefined : readFileSync(join(folder, file), "utf8").replaceAll("\r\n", "\n").trim();
}
