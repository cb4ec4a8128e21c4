// npm run bench: builds, then prints the benchmark tables. Arguments go to the benchmarks.
import { build } from "./build/build.js";
import { command } from "./lib/command.js";
import { runCompiled } from "./lib/compiled.js";
import { mustRun } from "./lib/run.js";
import { setUpForBuild } from "./setup/setup.js";

await command(async () => {
  await setUpForBuild();
  await build();
  const what = ["--package", "hpr-tests", "--bin", "bench_native"];
  await mustRun("cargo", ["build", "--locked", "--release", ...what], "The native benchmark does not build");
  await runCompiled("bench", {});
});
