import { existsSync, readFileSync } from "node:fs";

import { chromium } from "playwright-core";

import { Problem, findOnPath, run, say } from "../lib/run.js";

/** True on Debian itself (not on its relatives), if this user may install packages. */
function canInstallOnDebian(): boolean {
  return process.getuid?.() === 0 && findOnPath("apt-get") !== undefined && distribution() === "debian";
}

/** Installs a Debian package. True if that succeeded. */
async function aptInstall(name: string): Promise<boolean> {
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

/** Chromium without its desktop part. Pages open in half the time, and the tests take a third less. */
const SHELL = "chromium-headless-shell";
const COMMANDS = [SHELL, "chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

let browser: Promise<string> | undefined;

/**
 * The Chromium that tests the page: from HPR_CHROMIUM, from the PATH, or Playwright's
 * own. If there is none, one is installed. Two checks may ask for it at the same time,
 * and a second apt-get would fail at the lock of the first.
 */
export function setUpBrowser(): Promise<string> {
  return (browser ??= findOrInstall());
}

async function findOrInstall(): Promise<string> {
  const named = process.env["HPR_CHROMIUM"] !== undefined;
  if (!named && findOnPath(SHELL) === undefined && canInstallOnDebian()) {
    say(`Installing Chromium (${SHELL}) for the page's tests…`);
    await aptInstall(SHELL);
  }
  const found = findBrowser();
  if (found !== undefined) return found;

  say("Installing Chromium for the page's tests (a minute or less)…");
  await installBrowser();
  const installed = findBrowser();
  if (installed !== undefined) return installed;
  throw new Problem(
    "Chromium could not be installed (the messages above say why). " +
      "Install Chromium or Chrome yourself, or name one in HPR_CHROMIUM.",
  );
}

/** The Chromium that HPR_CHROMIUM names or that is installed, if any. */
function findBrowser(): string | undefined {
  const named = process.env["HPR_CHROMIUM"];
  if (named !== undefined) {
    if (existsSync(named)) return named;
    throw new Problem(`HPR_CHROMIUM names ${named}, which does not exist.`);
  }
  const onPath = COMMANDS.map(findOnPath).find((path) => path !== undefined);
  if (onPath !== undefined) return onPath;
  const playwrights = chromium.executablePath();
  return existsSync(playwrights) ? playwrights : undefined;
}

async function installBrowser(): Promise<void> {
  // Debian's package comes first if it is available: it includes all libraries that it
  // needs, and it may be reachable when downloads are not.
  if (canInstallOnDebian() && (await aptInstall("chromium"))) return;
  // Playwright may ask for a password to install libraries. So it installs them only
  // if it does not need one.
  const libraries = process.getuid?.() === 0 ? ["--with-deps"] : [];
  await run("playwright-core", ["install", ...libraries, "--no-shell", "chromium"]);
}
