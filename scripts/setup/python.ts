import { existsSync, readdirSync, rmSync } from "node:fs";

import { inRoot, mustRun, say, succeeds } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";

const FOLDER = "target/python";

/** The Python of the tests, in an environment of its own. */
export const python = inRoot(FOLDER, "bin", "python");

const WHEELS = "target/python-wheels";
const BUILD = ["-m", "maturin", "build", "--quiet", "--profile", "quick", "--manifest-path", "python/Cargo.toml"];

/**
 * Installs the Python package of this repository into an environment of its own, with the packages of its tests.
 *
 * @param packages more packages from PyPI.
 * @returns the reason why this machine cannot do that; undefined if the package is installed.
 */
export async function setUpPython(packages: string[]): Promise<string | undefined> {
  if (!(await succeeds("python3", "-c", "import sys; sys.exit(sys.version_info < (3, 10))"))) {
    return "there is no Python 3.10 or later";
  }
  if (!existsSync(python) && !(await succeeds("python3", "-m", "venv", inRoot(FOLDER)))) {
    rmSync(inRoot(FOLDER), { recursive: true, force: true });
    return "this Python cannot make environments (the module venv is missing)";
  }
  const wanted = ["maturin>=1.9,<2", "numpy>=1.24", "pytest>=8", ...packages];
  if (!(await succeeds(...pip("--dry-run", "--no-index", ...wanted)))) {
    say(`Installing ${wanted.join(", ")} into ${FOLDER}…`);
    if (!(await succeeds(...pip(...wanted)))) return "the packages of the tests could not be installed from PyPI";
  }
  const work = {
    name: "python",
    inputs: ["python", "src", "Cargo.toml"],
    outputs: [FOLDER],
    ignore: ["src/ts", "python/target"],
  };
  await unlessUnchanged(work, async () => {
    say("Building the Python package (about a minute)…");
    rmSync(inRoot(WHEELS), { recursive: true, force: true });
    const env = { CARGO_TARGET_DIR: inRoot("target/python-build") };
    await mustRun(python, [...BUILD, "--out", WHEELS], "The Python package could not be built", { env });
    const wheels = readdirSync(inRoot(WHEELS)).map((name) => inRoot(WHEELS, name));
    const [command, ...args] = pip("--no-deps", "--force-reinstall", ...wheels);
    await mustRun(command, args, "The Python package could not be installed");
  });
  return undefined;
}

/** Python compiles the modules that are imported. All of SciPy takes 7 s. */
function pip(...args: string[]): [string, ...string[]] {
  return [python, "-m", "pip", "install", "--quiet", "--no-compile", "--disable-pip-version-check", ...args];
}
