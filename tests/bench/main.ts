// npm run bench [-- --json] [--peers] [--fidelity]
//
// Milliseconds are medians of one run on one machine; compare ratios.
import { existsSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { spawnSync } from "node:child_process";

import { init } from "hidden-point-removal";

import { bunny36k, type Cloud, dragon, root } from "./clouds.js";
import { scoreRadiusChoices } from "./fidelity.js";
import { printTable, type Row } from "./report.js";
import { timeCloud } from "./speed.js";

const options = new Set(process.argv.slice(2));
const known = ["--json", "--peers", "--fidelity"];
const unknown = [...options].find((option) => !known.includes(option));
if (unknown !== undefined) {
  console.error(`Unknown option ${unknown}; there are ${known.join(", ")}.`);
  process.exit(2);
}

await init();
const tables: Record<string, Row[]> = {};
if (options.has("--fidelity")) {
  tables["Error against ray-traced visibility"] = scoreRadiusChoices();
} else {
  const python = options.has("--peers") ? pythonWithSciPy() : undefined;
  const bunny = bunny36k();
  const clouds: Cloud[] = [
    dragon("dragon"),
    dragon("dragon_res2"),
    dragon("dragon_res3"),
    dragon("dragon_res4"),
    ...(bunny === undefined ? [] : [bunny]),
  ];
  tables["Cold queries from 2.5 bounding radii, one core"] = clouds.flatMap((cloud) =>
    timeCloud(cloud, python),
  );
}

const machine = `${cpus()[0]?.model.trim() ?? "unknown CPU"}, ${cpus().length} cores, Node ${process.version}`;
if (options.has("--json")) {
  console.log(JSON.stringify({ machine, tables }, undefined, 2));
} else {
  console.log(machine);
  for (const [title, rows] of Object.entries(tables)) printTable(title, rows);
}

/** Python with SciPy, installed into target/ where the system's has none. */
function pythonWithSciPy(): string | undefined {
  const local = join(root, "target", "bench-python");
  process.env["PYTHONPATH"] = local;
  const works = (): boolean => spawnSync("python3", ["-c", "import scipy, numpy"]).status === 0;
  if (!works() && !existsSync(local)) {
    console.error("Installing SciPy into target/bench-python…");
    spawnSync("python3", ["-m", "pip", "install", "--quiet", "--target", local, "scipy"], {
      stdio: ["ignore", "ignore", "inherit"],
    });
  }
  if (works()) return "python3";
  console.error("Left out: the comparison with SciPy needs Python 3 with pip.");
  return undefined;
}
