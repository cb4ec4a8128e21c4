// npm run test:scale [-- --points N] [--files N]: the tests of the Python package with Dask, LAZ and Parquet, and
// then tiles against one cloud.
import { Problem, mustRun } from "./lib/run.js";
import { pytest } from "./checks/languages.js";
import { python, setUpPython } from "./setup/python.js";

/** The optional packages of python/pyproject.toml, and that of `SeenBy.matrix`. */
const OPTIONAL = ["dask[distributed]>=2024.1", "laspy[lazrs]>=2.5", "pyarrow>=14", "scipy>=1.11"];

export async function scale(args: string[]): Promise<void> {
  const lacking = await setUpPython(OPTIONAL);
  if (lacking !== undefined) throw new Problem(`The tests of tiles cannot run here: ${lacking}.`);
  // The tests that need these packages. Others skip themselves for other reasons.
  const { failed, left } = await pytest("python/tests", "-k", "test_tiles or laspy or matrix");
  if (failed > 0) throw new Problem(`${failed} tests of the Python package failed.`);
  if (left > 0) throw new Problem(`${left} tests of the Python package were skipped.`);
  const wrong = "Tiles answer otherwise than one cloud, or take too much";
  await mustRun(python, ["python/tests/scale.py", ...args], wrong, { show: "results" });
}
