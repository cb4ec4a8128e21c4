import { Problem, run } from "../lib/run.js";

/** A publication that was rehearsed: its command, and what the command says that it would send. */
export interface Rehearsal {
  command: string;
  sends: string;
}

/** Rehearses both publications, without sending anything. */
export async function rehearse(): Promise<Rehearsal[]> {
  return [
    await rehearsed("cargo", ["publish", "--dry-run", "--locked"], /^\s*Packaged (.+)$/m),
    await rehearsed(
      "npm",
      ["publish", "--dry-run", "--provenance", "--access", "public"],
      /^npm notice (total files.+)$/m,
    ),
  ];
}

async function rehearsed(program: string, args: string[], sends: RegExp): Promise<Rehearsal> {
  const command = [program, ...args].join(" ");
  const { ok, output } = await run(program, args);
  if (!ok) throw new Problem(`${command} failed (the messages above say why).`);
  return { command, sends: sends.exec(output)?.[1] ?? "" };
}

interface Facts {
  version: string;
  /** The commit with its day. */
  commit: string;
  untested: boolean;
  rehearsals: Rehearsal[];
  /** The commands that a release would run from here. */
  commands: string[];
  /** The reasons why a release would refuse from here on this machine. */
  missing: string[];
}

/** The text of tests/release/REHEARSED.md. */
export function report({ version, commit, untested, rehearsals, commands, missing }: Facts): string {
  const rows = [
    ["version", version],
    ["commit", commit],
    ["tree, versions, changelog and tag", "ready"],
    ["tests", untested ? "not run in this rehearsal (`--untested`); only built" : "passed"],
    ...rehearsals.map(({ command, sends }) => [`\`${command}\``, sends]),
  ];
  const list = (lines: string[]) => lines.map((line) => `- ${line}`).join("\n");
  return `# A release, up to the point where something would be sent

Written by \`npm run release -- --dry-run\`, which sends nothing.

| | |
|---|---|
${rows.map((row) => `| ${row.join(" | ")} |`).join("\n")}

From here, a release would date the changelog and run:

${list(commands.map((each) => `\`${each}\``))}

${missing.length === 0 ? "Nothing is missing for that." : `It would refuse from here on this machine:\n\n${list(missing)}`}
`;
}
