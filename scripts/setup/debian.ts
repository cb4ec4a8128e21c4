import { readFileSync } from "node:fs";

import { findOnPath } from "../lib/paths.js";
import { run } from "../lib/run.js";

/** True on Debian itself (not on its relatives), if this user may install packages. */
export function canInstallOnDebian(): boolean {
  return process.getuid?.() === 0 && findOnPath("apt-get") !== undefined && distribution() === "debian";
}

/** Installs a Debian package. True if that succeeded. */
export async function aptInstall(name: string): Promise<boolean> {
  const env = { DEBIAN_FRONTEND: "noninteractive" };
  await run("apt-get", ["update", "-qq"], { env });
  return (await run("apt-get", ["install", "-y", "-qq", "--no-install-recommends", name], { env })).ok;
}

function distribution(): string | undefined {
  try {
    return /^ID="?(\w+)/m.exec(readFileSync("/etc/os-release", "utf8"))?.[1];
  } catch {
    return undefined;
  }
}
