// npm run bits: builds one corpus of questions for every platform that this machine can run, and runs it
// there. All answers must have the same bits. Writes tests/bits/RESULTS.md; ends with status 1 on a difference.
import { readFileSync, writeFileSync } from "node:fs";

import { answersIn, answersOn, firstDifference } from "./bits/corpus.js";
import type { Answers } from "./bits/corpus.js";
import { PLATFORMS } from "./bits/platforms.js";
import type { Platform } from "./bits/platforms.js";
import { command } from "./lib/command.js";
import { findOnPath, inRoot } from "./lib/paths.js";
import { Problem, run, say } from "./lib/run.js";
import { setUpLinker } from "./setup/linker.js";
import { setUpRust } from "./setup/rust.js";

const RESULT = "tests/bits/RESULTS.md";

interface Row {
  platform: string;
  cells: string[];
}

await command(async () => {
  await setUpRust();
  await setUpLinker();
  const rows: Row[] = [];
  const skipped = new Map(PLATFORMS.map(([name]) => [name, "not run, because the command ended earlier"]));
  let expected: Answers | undefined;
  for (const [name, prepare] of PLATFORMS) {
    say(`\n${name}…`);
    const platform = await orReason(prepare(name));
    if (typeof platform === "string") {
      skipped.set(name, platform);
    } else {
      skipped.delete(name);
      const ran = await answersOn(platform);
      const answers = ran && answersIn(ran.output);
      expected ??= answers;
      const verdict = judge(expected, answers);
      if (verdict !== "equal") process.exitCode = 1;
      const seconds = ran === undefined ? "" : ran.seconds.toFixed(1);
      const cells = [runBy(platform), seconds, String(answers?.cases.size ?? ""), `\`${answers?.all ?? ""}\``, verdict];
      rows.push({ platform: `${name} (\`${[platform.target, ...platform.build.slice(2)].join(" ")}\`)`, cells });
      say(`${name}: ${verdict}`);
    }
    // The file is written after each platform, so that a run that ends early keeps its rows.
    const versions = await versionsOfTools();
    writeFileSync(inRoot(RESULT), report(versions, rows, skipped, expected?.cases.size ?? 0));
  }
  console.log(`\n${readFileSync(inRoot(RESULT), "utf8")}\n${RESULT}`);
});

/** The platform, or the reason why this machine cannot run it. */
async function orReason(platform: Promise<Platform>): Promise<Platform | string> {
  try {
    return await platform;
  } catch (error) {
    if (error instanceof Problem) return error.message;
    throw error;
  }
}

function judge(expected: Answers | undefined, got: Answers | undefined): string {
  if (expected === undefined || got === undefined) return "FAILED: no answers";
  const different = firstDifference(expected, got);
  return different === undefined ? "equal" : `DIFFERENT, first in ${different}`;
}

function runBy({ runner: [program] }: Platform): string {
  if (program === undefined) return "this machine";
  return program === process.execPath ? "Node" : program;
}

/** The versions of the tools. Called after the missing tools are installed. */
async function versionsOfTools(): Promise<string> {
  const version = async (program: string, ...args: string[]): Promise<string> => {
    const { output } = await run(program, args, { show: "nothing" });
    return output.split("\n")[0]!.trim();
  };
  const qemu = findOnPath("qemu-aarch64") === undefined ? [] : [await version("qemu-aarch64", "--version")];
  return [await version("rustc", "--version"), ...qemu, `Node ${process.version}`].join("; ");
}

function report(versions: string, rows: Row[], skipped: Map<string, string>, cases: number): string {
  const table = rows.map(({ platform, cells }) => `| ${[platform, ...cells].join(" | ")} |`);
  const reasons = [...skipped].map(([name, reason]) => `- ${name}: ${reason}`);
  return `# The same bits everywhere

Written by \`npm run bits\` on ${new Date().toISOString().slice(0, 10)}, with ${versions}.

One corpus of ${cases} cases (\`corpus.rs\`): all kinds of scenes of the core's tests, thin clouds, tiny and huge
units, map coordinates, 12 to 20,000 points; every inversion, rule of the radius and kind of question. The digest
covers all visible sets, meshes, brightness, scores and radii. Dimensions 4 and higher are not promised to the bit and
are left out. "Optimized" is the profile \`quick\`: the profile of a release, without optimization across crates.

| platform | run by | seconds | cases | digest of all | |
|---|---|---:|---:|---|---|
${table.join("\n")}

Skipped:${reasons.length === 0 ? " nothing." : `\n\n${reasons.join("\n")}`}
`;
}
