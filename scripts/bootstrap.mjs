// Runs one of the project's commands: `node scripts/bootstrap.mjs NAME` runs NAME of scripts/commands.ts.
//
// The commands are written in TypeScript, which a fresh clone cannot run. This file, the only plain
// JavaScript among the scripts, installs the npm packages when they do not match the lock file,
// compiles the scripts when they changed, and starts the command.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync, statSync, writeFileSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const scripts = dirname(fileURLToPath(import.meta.url));
const root = dirname(scripts);
const compiled = join(root, "target", "scripts");

requireNode(20);
if (!packagesMatchLock()) installPackages();
if (!scriptsCompiled()) compileScripts();
await import(pathToFileURL(join(compiled, "commands.js")).href);

function requireNode(major) {
  if (Number(process.versions.node.split(".")[0]) >= major) return;
  fail(`Node ${major} or newer is needed; this is ${process.version}. See https://nodejs.org`);
}

/** npm writes down what it installed in node_modules/.package-lock.json. */
function packagesMatchLock() {
  const installed = join(root, "node_modules", ".package-lock.json");
  if (!existsSync(installed)) return false;
  const have = JSON.parse(readFileSync(installed, "utf8")).packages;
  const wanted = JSON.parse(readFileSync(join(root, "package-lock.json"), "utf8")).packages;
  return Object.entries(wanted).every(
    ([path, entry]) =>
      // The project itself and binaries for other platforms need not match.
      path === "" || entry.optional || entry.devOptional || have[path]?.integrity === entry.integrity,
  );
}

function installPackages() {
  console.log("Installing npm packages (about 10 seconds)…");
  const done = run("npm", ["ci", "--include=dev", "--no-audit", "--no-fund", "--loglevel=error"]);
  if (!done) fail("The npm packages could not be installed (the messages above say why).");
}

function compileScripts() {
  const tsc = join(root, "node_modules", "typescript-native", "bin", "tsc");
  const done = run(process.execPath, [tsc, "-p", scripts]);
  if (!done) fail("The scripts do not compile.");
  mkdirSync(compiled, { recursive: true });
  writeFileSync(join(compiled, "done"), "");
}

function scriptsCompiled() {
  const stamp = join(compiled, "done");
  if (!existsSync(stamp)) return false;
  const newest = Math.max(
    ...readdirSync(scripts, { recursive: true }).map((name) => statSync(join(scripts, name)).mtimeMs),
    ...["package-lock.json", "tsconfig.base.json"].map((name) => statSync(join(root, name)).mtimeMs),
  );
  return statSync(stamp).mtimeMs >= newest;
}

function run(command, args) {
  const shell = process.platform === "win32" && command === "npm";
  return spawnSync(command, args, { cwd: root, stdio: "inherit", shell }).status === 0;
}

function fail(message) {
  console.error(message);
  process.exit(1);
}
