// Python packages for the peers. They are installed into target/ if the system does not have them.
import { existsSync, rmSync } from "node:fs";
import { spawnSync } from "node:child_process";
import { join } from "node:path";

import { root } from "./paths.js";

export interface Python {
  env: Record<string, string>;
  version: string;
}

/**
 * A Python that can import a module, and the module's version. If the import fails, pip tries
 * `packages` in turn until the import works. The packages go into a directory of their own.
 */
export function withPython(module: string, packages: string[]): Python | undefined {
  const local = join(root, "target", `bench-${module}`);
  const env = { PYTHONPATH: local };
  const found = (): Python | undefined => {
    const script = `import ${module}; print(${module}.__version__)`;
    const { status, stdout } = spawnSync("python3", ["-c", script], {
      encoding: "utf8",
      env: { ...process.env, ...env },
    });
    return status === 0 ? { env, version: stdout.trim() } : undefined;
  };
  for (const name of packages) {
    const python = found();
    if (python !== undefined) return python;
    console.error(`Installing ${name} into target/bench-${module}…`);
    const pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--target", local, name];
    const { status } = spawnSync("python3", pip, { stdio: ["ignore", "ignore", "inherit"] });
    if (status !== 0 && existsSync(local)) rmSync(local, { recursive: true });
  }
  return found();
}
