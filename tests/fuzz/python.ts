import { existsSync } from "node:fs";
import { join } from "node:path";
import { spawnSync } from "node:child_process";

/** A Python with these packages in an environment of its own under target/, or nothing where Python 3 or PyPI is missing. */
export function pythonWith(name: string, packages: string[]): string | undefined {
  const folder = join(import.meta.dirname, "../../target", name);
  const python = join(folder, "bin/python");
  const succeeds = (command: string, ...args: string[]) => spawnSync(command, args, { stdio: "ignore" }).status === 0;
  const imported = `import ${packages.map((versioned) => versioned.split("==")[0]).join(", ")}`;
  if (existsSync(python) && succeeds(python, "-c", imported)) return python;
  const isInstalled =
    succeeds("python3", "-m", "venv", folder) && succeeds(python, "-m", "pip", "install", "--quiet", ...packages);
  return isInstalled ? python : undefined;
}
