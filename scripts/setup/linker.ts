import { findOnPath } from "../lib/paths.js";
import { Problem, say } from "../lib/run.js";
import { aptInstall, canInstallOnDebian } from "./debian.js";

/** rustc links programs for this machine through the system's C compiler. */
export async function setUpLinker(): Promise<void> {
  if (process.platform === "win32" || findOnPath("cc") !== undefined) return;
  if (canInstallOnDebian()) {
    say("Installing a C compiler (build-essential), which Rust links with…");
    if (await aptInstall("build-essential")) return;
  }
  const wayOut =
    process.platform === "darwin"
      ? "run `xcode-select --install`"
      : "install your system's C compiler (on Debian and Ubuntu: sudo apt-get install build-essential)";
  throw new Problem(`Rust links with the C compiler \`cc\`, which is missing: ${wayOut}.`);
}
