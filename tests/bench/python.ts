// A Python with SciPy. It is installed into target/ if the system does not have it.
import { existsSync, rmSync } from "node:fs";
import { spawnSync } from "node:child_process";
import { join } from "node:path";

import { root } from "./paths.js";

interface Python {
  env: Record<string, string>;
  version: string;
}

/** Undefined if SciPy can neither be imported nor installed. */
export function withScipy(): Python | undefined {
  const local = join(root, "target", "bench-scipy");
  const env = { PYTHONPATH: local };
  const found = (): Python | undefined => {
    const { status, stdout } = spawnSync("python3", ["-c", "import scipy; print(scipy.__version__)"], {
      encoding: "utf8",
      env: { ...process.env, ...env },
    });
    return status === 0 ? { env, version: stdout.trim() } : undefined;
  };
  const installed = found();
  if (installed !== undefined) return installed;
  console.error(`Installing SciPy into ${local}…`);
  const pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--target", local, "scipy"];
  const { status } = spawnSync("python3", pip, { stdio: ["ignore", "ignore", "inherit"] });
  if (status !== 0 && existsSync(local)) rmSync(local, { recursive: true });
  return found();
}
