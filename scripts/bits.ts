// npm run bits: builds one corpus of questions for every platform that this machine can run, and runs it
// there. All answers must have the same bits. Ends with status 1 on a difference.
import { answersIn, answersOn, firstDifference } from "./bits/corpus.js";
import type { Answers } from "./bits/corpus.js";
import { PLATFORMS } from "./bits/platforms.js";
import type { Platform } from "./bits/platforms.js";
import { command } from "./lib/command.js";
import { findOnPath } from "./lib/paths.js";
import { Problem, run, say } from "./lib/run.js";
import { setUpLinker } from "./setup/linker.js";
import { setUpRust } from "./setup/rust.js";

await command(async () => {
  await setUpRust();
  await setUpLinker();
  const rows: string[] = [];
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
      const seconds = ran === undefined ? "" : `${ran.seconds.toFixed(1)} s`;
      const target = [platform.target, ...platform.build.slice(2)].join(" ");
      rows.push([verdict, answers?.all, `${name} (${target})`, runBy(platform), seconds].join("  "));
      say(`${name}: ${verdict}`);
    }
  }
  for (const [name, reason] of skipped) rows.push(`skipped: ${name}: ${reason}`);
  console.log(`\n${await versionsOfTools()}; ${expected?.cases.size ?? 0} cases\n${rows.join("\n")}`);
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
