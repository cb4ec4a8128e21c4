// npm run release -- [--dry-run] [--untested]: publishes crate and package of one version.
//
// It checks that the repository is ready, runs the tests, rehearses both publications, dates the
// changelog, commits, tags, and publishes. A dry run ends before anything is sent.
import { readFileSync, writeFileSync } from "node:fs";
import { parseArgs } from "node:util";

import { build } from "./build/build.js";
import { command } from "./lib/command.js";
import { inRoot, root } from "./lib/paths.js";
import { Problem, mustRun, run } from "./lib/run.js";
import { dated, sectionOf } from "./release/changelog.js";
import { provenanceRefusals } from "./release/provenance.js";
import { refusals } from "./release/refusals.js";
import { rehearse } from "./release/rehearsal.js";
import { statedVersions } from "./release/version.js";
import { setUpForBuild } from "./setup/setup.js";

const CHANGELOG = inRoot("CHANGELOG.md");

await command(async () => {
  const { dryRun, untested } = asked();
  const version = statedVersions(root)["Cargo.toml"] ?? "";
  const reasons = [...refusals(root), ...(dryRun ? [] : provenanceRefusals(root))];
  if (reasons.length > 0) throw new Problem(`${version} cannot be released:\n${list(reasons)}`);

  await setUpForBuild();
  if (untested) await build();
  else await mustRun("npm", ["test"], "The tests failed, so nothing was released", { show: "results" });
  await rehearse();

  const today = new Date().toISOString().slice(0, 10);
  const { body = "" } = sectionOf(readFileSync(CHANGELOG, "utf8"), version) ?? {};
  const steps: [name: string, program: string, args: string[]][] = [
    ["commit", "git", ["commit", "--all", "--message", `release: ${version}`]],
    ["tag", "git", ["tag", "--annotate", `v${version}`, "--cleanup=verbatim", "--message", `${version}\n\n${body}`]],
    ["crate", "cargo", ["publish", "--locked"]],
    ["package", "npm", ["publish", "--provenance", "--access", "public"]],
    ["push", "git", ["push", "--follow-tags"]],
  ];
  if (dryRun) {
    const commands = steps.map(([, program, args]) => [program, ...args].join(" ").split("\n", 1)[0]!);
    console.log(
      `\nReady. A release would date the section ${version} of CHANGELOG.md ${today}, then run:\n${list(commands)}`,
    );
    const missing = provenanceRefusals(root);
    if (missing.length > 0) console.log(`\nIt would refuse from here, since:\n${list(missing)}`);
    return;
  }
  writeFileSync(CHANGELOG, dated(readFileSync(CHANGELOG, "utf8"), version, today));
  for (const [name, program, args] of steps) {
    // If the changelog already has its date, there is nothing to commit.
    if (name === "commit" && (await run("git", ["diff", "--quiet"], { show: "nothing" })).ok) continue;
    await mustRun(program, args, `The release stopped at this step: ${name}`, { show: "results" });
  }
});

function asked(): { dryRun: boolean; untested: boolean } {
  const flag = { type: "boolean", default: false } as const;
  try {
    const { values } = parseArgs({ args: process.argv.slice(3), options: { "dry-run": flag, untested: flag } });
    return { dryRun: values["dry-run"], untested: values.untested };
  } catch (error) {
    throw new Problem(`${(error as Error).message}\nnpm run release -- [--dry-run] [--untested]`);
  }
}

function list(lines: string[]): string {
  return lines.map((line) => `  ${line}`).join("\n");
}
