// `npm run NAME -- ARGUMENTS` runs a command. Each installs and builds what it needs.
import { spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";

import { build, buildPackage } from "./build/build.js";
import { vitest } from "./checks/check.js";
import { TSC, Problem, environment, inRoot, mustRun, root } from "./lib/run.js";
import { setUpRust } from "./setup/rust.js";
import { setUpBrowser } from "./setup/system.js";
import { THIRD_PARTY, shipped, thirdPartyText } from "./supply/third-party.js";

type Command = (args: string[]) => Promise<void>;

const COMMANDS: Record<string, Command> = {
  start: async () => (await import("./start.js")).start(),
  test: async (args) => (await import("./test.js")).test(args),
  fuzz: async (args) => (await import("./fuzz.js")).fuzz(args),
  soak: async (args) => (await import("./soak.js")).soak(args),
  scale: async (args) => (await import("./scale.js")).scale(args),

  /** The npm package in dist, and the demo page in www/dist. */
  async build([part, ...more]) {
    if ((part !== undefined && part !== "package") || more.length > 0) {
      throw new Problem("npm run build takes nothing, or: npm run build -- package");
    }
    await (part === undefined ? build() : buildPackage());
  },

  /** Prints the tables of times and memory. */
  async bench(args) {
    await build();
    const what = ["--package", "hpr-tests", "--bin", "bench_native"];
    await mustRun("cargo", ["build", "--locked", "--release", ...what], "The native benchmark does not build");
    await runCompiled("bench", args);
  },

  /** Prints how often answers are wrong. `--real` scores labeled scans. */
  async fidelity(args) {
    await build();
    await runCompiled("fidelity", args);
  },

  /** Draws the paper's figures, or those that the arguments name. */
  async figures(args) {
    await build();
    await runCompiled("figures", args, { HPR_CHROMIUM: await setUpBrowser() });
  },

  /** Writes the API reference of both packages, from their doc comments. */
  async docs() {
    await buildPackage();
    await mustRun("typedoc", [], "The reference of the npm package could not be built");
    await mustRun("cargo", ["doc", "--locked", "--no-deps"], "The reference of the crate could not be built");
    console.log("npm package: target/docs/npm/index.html\ncrate: target/doc/hidden_point_removal/index.html");
  },

  /**
   * Tests the packed package in every bundler, framework, page and runtime, and writes tests/consumers/MATRIX.md. npm
   * installs the tools of most of them. `npm test` runs only those that need nothing more.
   */
  async consumers() {
    await build();
    const env = { HPR_CHROMIUM: await setUpBrowser(), HPR_CONSUMERS: "all" };
    const { failed } = await vitest("tests/consumers", { env });
    if (failed > 0) process.exitCode = 1;
  },

  /** Writes THIRD_PARTY.md. */
  async licenses() {
    await setUpRust();
    writeFileSync(THIRD_PARTY, thirdPartyText(await shipped()));
    console.log("THIRD_PARTY.md");
  },
};

const [name = "", ...args] = process.argv.slice(2);
try {
  await COMMANDS[name]!(args);
} catch (error) {
  if (!(error instanceof Problem)) throw error;
  console.error(`\n${error.message}`);
  process.exitCode = 1;
}

/** Compiles a folder of tests and runs its main program. */
async function runCompiled(folder: string, args: string[], env: Record<string, string> = {}): Promise<void> {
  await mustRun(process.execPath, [TSC, "-p", `tests/${folder}`], `tests/${folder} does not compile`);
  const program = inRoot("target", folder, "tests", folder, "main.js");
  const settings = { cwd: root, env: environment(env), stdio: "inherit" } as const;
  process.exitCode = spawnSync(process.execPath, [program, ...args], settings).status ?? 1;
}
